"""Values that only a run will measure: nothing is said against a plan that depends on them."""

import json
from pathlib import Path

from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc_ontology import catalogue

PROBING = """
use skiros, rparts, cora, skillc, wiping
prefix lab: <http://example.org/lab#>
import "motion.skill"
import "surfaces.skill"

property height(Surface): Length

skill Measure {
    in   surface: WipeableSurface
    post sensed known: surface has height
    noplan
}

impl by_eye of Measure { do wait until surface has height }

skill Touch {
    in    surface: WipeableSurface
    infer arm:     ArmDevice
    infer robot:   Robot
    infer station: Location
    pre   robot hasA arm
    pre   robot at station
    pre   station contain surface
    post  sensed touched: surface.isClean == true
}

impl measured of Touch {
    refine arm: CompliantArm
    do seq {
        Measure(surface)
        MoveTo(arm, target: offset(surface.pose, surface.height * surface.normal))
        wait until surface.isClean == true
    }
}

task touch {
    scene "cell.ttl"
    goal  lab:Desk-1.isClean == true
}
"""


def test_a_plan_stands_whose_step_depends_on_a_value_that_is_measured(tmp_path: Path) -> None:
    (tmp_path / "probing.skill").write_text(PROBING)
    (tmp_path / "cell.ttl").write_text(catalogue.scene_path("panda_desk").read_text())
    ran = CliRunner().invoke(skillc, ["plan", f"{tmp_path}:touch", "--json", "--no-plan-cache"])
    answer = json.loads(ran.stdout)
    assert answer["status"] == "solved", answer
    failure = answer["space"]["failure"]
    assert failure.startswith("MoveTo: lab:Desk-1 has no ") and "height" in failure
