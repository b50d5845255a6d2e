"""A body may not send two bases, or a base and an arm, into one place at the same time."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from refinement.scenes import two_bases
from skillc.cli.main import skillc
from skillc_ontology import catalogue

TASK = """
prefix lab: <http://example.org/lab#>
{imports}

task at_once {{
    scene "cell.ttl"
    do par all {{
        {calls}
    }}
}}
"""

SKILLS = {"driving": "Drive", "motion": "TakePosture"}

PANDA = """
lab:Scene-1 skiros:contain lab:Plinth-1 .
lab:Plinth-1 a skillc:Furniture ; skiros:SizeX 0.2 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.05 ;
    skiros:BaseFrameId "map" ; skiros:PositionX {x} ; skiros:PositionY 0.0 ; skiros:PositionZ 0.025 .
lab:Robot-9 a skillc:FixedRobot ; skillc:hasArm lab:Arm-9 .
lab:Arm-9 a skillc:Panda ; skillc:hasSheet skillc:panda-sheet ; skiros:CompliantController "impedance" ;
    skillc:on lab:Plinth-1 ; skillc:deviceState "Idle" ; skillc:hasGripper lab:Hand-9 .
lab:Hand-9 a skillc:PandaHand ; skillc:hasSheet skillc:panda-hand-sheet ; skillc:deviceState "Idle" .
"""


def check(folder: Path, scene: str, *calls: str) -> list[str]:
    (folder / "cell.ttl").write_text(scene)
    imports = [f'import "{name}.skill"' for name, skill in SKILLS.items() if any(f"{skill}(" in each for each in calls)]
    imports += ['import "zone.skill"'] if (folder / "zone.skill").exists() else []
    (folder / "tasks.skill").write_text(TASK.format(imports="\n".join(imports), calls="\n        ".join(calls)))
    found = json.loads(CliRunner().invoke(skillc, ["check", str(folder), "--json", "--no-cache"]).stdout)
    assert {each["name"] for each in found} <= {"infeasible-step"}, found
    return [each["message"] for each in found]


@pytest.mark.slow
def test_a_base_may_not_come_to_where_another_one_only_then_drives_off(tmp_path: Path) -> None:
    leaving, coming = "Drive(robot: lab:Heron-1, to: lab:BoardStation)", "Drive(robot: lab:Heron-2, to: lab:Dock)"
    (told,) = check(tmp_path, two_bases(), leaving, coming)
    assert "lab:Heron-1 and lab:Heron-2 would come into one place at the same time" in told


ZONE = """
skill DriveAlone {
    in    robot: MobileRobot
    in    to:    Workstation
    in    zone:  Workstation
    infer from:  Location
    pre   robot at from
    pre   away: not from == to
    post  robot at to
    post  not robot at from
    uses  zone
    noplan
}

impl driving of DriveAlone { do Drive(robot, to) }
"""


@pytest.mark.slow
@pytest.mark.parametrize(("second", "meets"), [("Dock", False), ("BoardStation", True)])
def test_who_uses_one_zone_drives_one_after_the_other(second: str, meets: bool, tmp_path: Path) -> None:
    (tmp_path / "zone.skill").write_text('use skiros, skillc\nimport "driving.skill"\n' + ZONE)
    leaving = "DriveAlone(robot: lab:Heron-1, to: lab:BoardStation, zone: lab:Dock)"
    coming = f"DriveAlone(robot: lab:Heron-2, to: lab:Dock, zone: lab:{second})"
    assert len(check(tmp_path, two_bases(), leaving, coming)) == meets


@pytest.mark.slow
@pytest.mark.parametrize(("x_m", "meets"), [(-1.0, True), (-1.6, False)])
def test_a_base_and_an_arm_beside_where_it_starts(x_m: float, meets: bool, tmp_path: Path) -> None:
    """The base turns at (0, 0), with corners 0.43 m from there; the hand is 0.5 m before the arm."""
    scene = catalogue.scene_path("ur5e_whiteboard").read_text() + PANDA.format(x=x_m)
    calls = "Drive(robot: lab:Heron-1, to: lab:Store)", 'TakePosture(arm: lab:Arm-9, posture: "home")'
    told = check(tmp_path, scene, *calls)
    assert len(told) == meets
    assert all("lab:Heron-1 and lab:Arm-9 would come into one place at the same time" in each for each in told)
