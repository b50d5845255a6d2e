"""Two arms in one cell: each is an obstacle for the other, and no plan sends both into one place at the same time."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from refinement.two_arms import BOTH, SIDE_BY_SIDE, two_arms, write_two_arms
from skillc.cli.main import skillc

AT_ONCE = """
prefix lab: <http://example.org/lab#>
import "handling.skill"

task at_once {
    scene "cell.ttl"
    do par all {
        Pick(arm: lab:Arm-1, object: lab:Part-A)
        Pick(arm: lab:Arm-2, object: lab:Part-B)
    }
}
"""


def ask(command: str, scene: Path, *options: str) -> dict:
    asked = [command, "--library", "sorting", "--scene", str(scene), "--goal", BOTH, "--json", *options]
    return json.loads(CliRunner().invoke(skillc, asked).stdout)


@pytest.mark.slow
def test_steps_whose_arms_would_meet_do_not_run_at_the_same_time(tmp_path: Path) -> None:
    scene = write_two_arms(tmp_path, SIDE_BY_SIDE)
    facts = ask("plan", scene, "--minimise", "makespan", "--no-plan-cache", "--no-geometry")
    assert (facts["makespan_s"], facts["optimal"]) == (30.0, "proven")
    answer = ask("plan", scene, "--minimise", "makespan", "--no-plan-cache")
    assert {each["arguments"]["arm"] for each in answer["plan"]} == {"lab:Arm-1", "lab:Arm-2"}
    assert (answer["makespan_s"], answer["optimal"], answer["at_least_s"]) == (60.0, "best found", 30.0)
    assert {"one": 1, "other": 2, "arms": ["lab:Arm-1", "lab:Arm-2"]} in answer["space"]["apart"]
    assert answer["space"]["failure"] is None


@pytest.mark.slow
def test_arms_far_from_each_other_work_side_by_side(tmp_path: Path) -> None:
    far = {"Part-A": (-0.6, 0.0), "Part-B": (0.6, 0.0), "Box-A": (-0.6, 0.35), "Box-B": (0.6, -0.35)}
    answer = ask("plan", write_two_arms(tmp_path, far, 2.2), "--minimise", "makespan", "--no-plan-cache")
    assert (answer["makespan_s"], answer["optimal"], answer["space"]["apart"]) == (30.0, "proven", [])


@pytest.mark.slow
def test_a_body_that_sends_two_arms_into_one_place_is_refused(tmp_path: Path, incurable: None) -> None:
    (tmp_path / "tasks.skill").write_text(AT_ONCE)
    (tmp_path / "cell.ttl").write_text(two_arms(SIDE_BY_SIDE))
    found = json.loads(CliRunner().invoke(skillc, ["check", str(tmp_path), "--json", "--no-cache"]).stdout)
    told = [each["message"] for each in found if each["name"] == "infeasible-step"]
    assert len(told) == 1 and "lab:Arm-1 and lab:Arm-2 would come into one place" in told[0]


@pytest.mark.sim
def test_two_arms_do_not_touch_each_other(tmp_path: Path) -> None:
    """Side by side, as facts allow, the hands press against each other with 76 N, and the task fails."""
    result = ask("run", write_two_arms(tmp_path, SIDE_BY_SIDE), "--no-film")
    assert (result["status"], result["failure"]) == ("succeeded", None)
    assert result["touches"] == []
    assert {each["arguments"]["arm"]["label"] for each in result["plan"]} == {"lab:Arm-1", "lab:Arm-2"}
    assert result["plan_in_space"]["apart"]
