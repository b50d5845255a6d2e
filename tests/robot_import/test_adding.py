"""`skillc add robot FILE` writes an arm that a scene can use; what is still to be stated is listed."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from projects.folders import call, checked, names
from robot_import.arms import GEN3, LIFTER, railed, six

USE = ("lab:Arm-1 a cell:Six", "not lab:Arm-1 a skillc:Panda", "lab:Arm-1 skillc:hasSheet cell:six-sheet")
POSITIONS = (
    'lab:Arm-1 skiros:CompliantController "forward_dynamics"',
    "lab:Arm-1 skillc:hasSensor lab:Sensor-1",
    "lab:Sensor-1 a skillc:ForceTorqueSensor",
)
"""What an arm that takes positions needs besides."""
MODEL = "ontology/robots/six.xml"


@pytest.fixture
def project(tmp_path: Path, own_cache: Path) -> Path:
    assert call(tmp_path, "new", "cell", "--template", "wipe").exit_code == 0
    (tmp_path / "cell/six.urdf").write_text(six(), "utf-8")
    return tmp_path / "cell"


@pytest.mark.slow
def test_an_arm_like_a_shipped_one_is_used_by_a_scene(project: Path) -> None:
    added = call(project, "add", "robot", "six.urdf", "--like", "panda", "--set", "forceLimit=30", "--set", "reach=0.8")
    assert added.exit_code == 0, added.output
    assert added.stdout.split() == ["ontology/robots/six.ttl", MODEL, "skillc.toml"]
    assert "agree in 200 postures" in added.stderr and "the largest difference is" in added.stderr
    sheet = (project / "ontology/robots/six.ttl").read_text("utf-8")
    assert "skillc:forceLimit 30 ;" in sheet and "skillc:reach 0.8 ;" in sheet and "toBeStated" not in sheet
    assert "ForceTorqueSensor" not in added.stderr
    assert "As those of panda, to be checked: armature" in sheet and "user when the arm was added: forceLimit" in sheet
    assert checked(project) == []
    assert call(project, "scene", "edit", "cell.ttl", *USE).exit_code == 0
    (found,) = checked(project)
    assert found["name"] == "infeasible-step" and "link_6 would touch lab:Eraser-1" in found["message"]
    assert call(project, "plan", "--no-geometry", "--json").exit_code == 0


@pytest.mark.slow
def test_what_is_still_to_be_stated_is_listed_and_nothing_runs(project: Path) -> None:
    text = (project / "six.urdf").read_text("utf-8").replace('velocity="2"', 'velocity="0"', 1)
    (project / "six.urdf").write_text(text, "utf-8")
    home = "0 0.2 1.6 0 1.34 0"
    added = call(project, "add", "robot", "six.urdf", "--control", "position", "--home", home)
    assert added.exit_code == 0 and "still to be stated" in added.stderr, added.output
    assert "lab:Sensor-1 a skillc:ForceTorqueSensor" in added.stderr
    (found,) = checked(project)
    assert (found["name"], found["severity"]) == ("incomplete-sheet", "warning")
    assert found["path"] == "ontology/robots/six.ttl"
    for name in ("jointSpeeds", "armature", "servoStiffness", "admittance", "forceLimit", "contactForceLimit"):
        assert f"skillc:{name}" in found["message"]
    assert "skillc:hasPosture" not in found["message"] and "skillc:dampingFloor" not in found["message"]
    assert call(project, "scene", "edit", "cell.ttl", *USE, *POSITIONS).exit_code == 0
    assert sorted(names(checked(project)))[1][0] == "incomplete-sheet"
    assert [each["severity"] for each in checked(project)].count("error") == 1
    refused = call(project, "run", "--no-geometry")
    assert refused.exit_code != 0 and "skillc:armature" in refused.output and "still to be stated" in refused.output


@pytest.fixture
def empty(tmp_path: Path) -> Path:
    (tmp_path / "skillc.toml").write_text('name = "cell"\n', "utf-8")
    (tmp_path / "six.urdf").write_text(six(), "utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("six.urdf",), "--control torque, position or velocity"),
        (("none.urdf", "--like", "panda"), "none.urdf cannot be read"),
        (("six.urdf", "--like", "pandda"), "did you mean `panda`"),
        (("six.urdf", "--like", "panda", "--name", "My Arm"), "not a valid name"),
        (("six.urdf", "--like", "panda", "--tip", "tol0"), "did you mean `tool0`"),
        (("six.urdf", "--like", "panda", "--base", "link_2"), "4 joints move"),
        (("six.urdf", "--like", "panda", "--efforts", "1 2"), "--efforts: write 6 numbers"),
        (("six.urdf", "--like", "panda", "--efforts", "1 2 3 4 5 0"), "must be above 0"),
        (("six.urdf", "--like", "panda", "--home", "0 9 0 0 0 0"), "is not in the range of joint joint_2"),
        (("six.urdf", "--like", "panda", "--set", "forceLimit"), "write PROPERTY=VALUE"),
        (("six.urdf", "--like", "panda", "--set", "forcelimit=3"), "did you mean `forceLimit`"),
        (("six.urdf", "--like", "panda", "--set", "forceLimit=-3"), "must be above 0"),
        (("six.urdf", "--like", "panda", "--set", "admittance=1"), "no such property"),
        (("weak.urdf", "--like", "panda"), "states no effort, or 0, for joint_1: say how strong"),
        (("six", "--tip", "tool0"), "--tip is for `skillc add robot FILE`"),
    ],
)
def test_what_cannot_be_added_is_refused_and_nothing_is_written(
    arguments: tuple[str, ...], says: str, empty: Path
) -> None:
    (empty / "weak.urdf").write_text(six().replace('effort="80"', 'effort="0"', 1), "utf-8")
    refused = call(empty, "add", "robot", *arguments)
    assert refused.exit_code == 2 and says in refused.stderr, refused.output
    assert not (empty / "ontology").exists()


def test_without_pinocchio_a_sentence_says_what_to_do(empty: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    refused = call(empty, "add", "robot", "six.urdf", "--like", "panda")
    assert refused.exit_code == 2 and "(pinocchio): pip install 'skillc[robots]'" in refused.stderr


@pytest.mark.sim
@pytest.mark.parametrize(
    ("template", "urdf", "like", "control"),
    [
        ("wipe", LIFTER.read_text("utf-8"), "ur5e", "position"),
        ("pick-place", GEN3.read_text("utf-8"), "panda", "torque"),
        ("press", railed(), "ur5e", "position"),
    ],
    ids=["wipe-lifter", "pick-place-gen3", "press-railed"],
)
def test_an_added_arm_does_the_task_of_a_template(
    template: str, urdf: str, like: str, control: str, tmp_path: Path, own_cache: Path
) -> None:
    assert call(tmp_path, "new", "cell", "--template", template).exit_code == 0
    project = tmp_path / "cell"
    (project / "six.urdf").write_text(urdf, "utf-8")
    tip = ("--tip", "tool0") if "tool0" in urdf else ()
    added = call(project, "add", "robot", "six.urdf", "--like", like, *tip)
    assert added.exit_code == 0, added.output
    shipped = "Iiwa14" if template == "press" else "Panda"
    edits = [each.replace("Panda", shipped) for each in USE] + list(POSITIONS if control == "position" else ())
    assert call(project, "scene", "edit", "cell.ttl", *edits).exit_code == 0
    assert checked(project) == []
    ran = call(project, "run")
    assert ran.exit_code == 0, ran.output
    if template == "wipe":
        assert "isClean == true  idealised by Inspect" in ran.output and "100.0%" in ran.output
    elif template == "pick-place":
        misses = re.findall(r"really (\d+) mm .* (\d+) mm from where it should be", ran.output)
        assert len(misses) == 2 and all(float(mm) <= 5 for pair in misses for mm in pair), ran.output
    else:
        assert re.search(r"lab:Panel-1.isOn == true +reported by", ran.output), ran.output
