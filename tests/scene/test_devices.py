"""Data sheets that cannot be those of the devices that name them are told by `skillc check`, at their lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.check import library_checks
from skillc.services.library.check_inputs import compute_digest
from skillc.services.library.files import find_library
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue

SCENE = catalogue.scene_path("iiwa_table").read_text("utf-8")
OWN = """
lab:own-home a skillc:Posture ; skillc:postureName "home" ; skillc:jointValues "0.0 0.35 0.0 -1.75 0.0 1.04 0.0" .
lab:own-sheet a skillc:ArmSheet ; skillc:model "robots/iiwa14.xml" ; skillc:reach 0.82 ; skillc:shoulderHeight 0.36 ;
    skillc:jointSpeeds "1.4 1.4 1.7 1.3 2.2 2.3 2.3" ;
    skillc:armature 0.03 ; skillc:linearStiffness 1500 ; skillc:rotationalStiffness 200 ; skillc:dampingRatio 1 ;
    skillc:dampingFloor 60 ; skillc:rotationalDampingFloor 2 ; skillc:nullspaceStiffness 10 ; skillc:torqueRate 1000 ;
    skillc:commandTime 0.1 ; skillc:forceLimit 50 ; skillc:speedLimit 0.5 ; skillc:accelerationLimit 0.5 ;
    skillc:hasPosture lab:own-home .
"""
SIX = "0.0 0.35 0.0 -1.75 0.0 1.04"


def told(folder: Path, sheet: str, own: str = "", device: str = "skillc:iiwa14-sheet") -> list[Diagnostic]:
    """Return what is told of a scene in which a device has another sheet."""
    assert device in SCENE
    (folder / "s.ttl").write_text(SCENE.replace(device, sheet) + own, "utf-8")
    (folder / "t.skill").write_text("use skiros\nclass Rag < Product\n", "utf-8")
    return list(library_checks.check_library(find_library(folder), folder / "s.ttl"))


@pytest.mark.parametrize(
    ("device", "sheet", "name", "words"),
    [
        ("skillc:iiwa14-sheet", "skillc:wsg50-sheet", "wrong-sheet", "lab:Iiwa-1 needs a skillc:ArmSheet"),
        ("skillc:robotiq-3f-sheet", "skillc:iiwa14-sheet", "wrong-sheet", "lab:Robotiq-1 needs a skillc:GripperSheet"),
        ("wiping:eraser-sheet", "skillc:heron-sheet", "wrong-sheet", "lab:Eraser-1 needs a contact:RigidToolSheet or"),
        ("skillc:iiwa14-sheet", "skillc:ur5e-sheet", "unfit-sheet", "skillc:ur5e-sheet has no number"),
    ],
)
def test_the_sheet_of_another_device_is_told_at_its_line(
    tmp_path: Path, device: str, sheet: str, name: str, words: str
) -> None:
    (found,) = told(tmp_path, sheet, device=device)
    assert (found.name, found.severity) == (name, "error")
    assert words in found.message
    line = (tmp_path / "s.ttl").read_text("utf-8").splitlines()[found.span.line - 1]
    assert line[found.span.column - 1 : found.span.end_column - 1] == sheet


@pytest.mark.parametrize(
    ("old", "new", "name", "words"),
    [
        (f"{SIX} 0.0", SIX, "joint-numbers", "lab:own-home.skillc:jointValues has 6 numbers, and"),
        (f"{SIX} 0.0", f"{SIX} nought", "joint-numbers", "is not numbers separated by spaces"),
        ("1.4 1.4 1.7", "1.4 0 1.7", "joint-numbers", "must be above 0 for each joint"),
        ("1.4 1.4 1.7 1.3 2.2 2.3 2.3", "", "joint-numbers", "must be above 0 for each joint"),
        (
            "skillc:armature",
            'skillc:jointAccelerations "9 9" ; skillc:armature',
            "joint-numbers",
            "jointAccelerations has 2 numbers",
        ),
        ("skillc:armature", 'skillc:jointJerks "9 0" ; skillc:armature', "joint-numbers", "must be above 0"),
        ("robots/iiwa14.xml", "robots/ur5e.xml", "unfit-sheet", "its model has 6 joints, and its posture home 7"),
        ("robots/iiwa14.xml", "robots/gone.xml", "unfit-sheet", "no model robots/gone.xml"),
        ("robots/iiwa14.xml", "robots/ur5e.ttl", "unfit-sheet", "its model cannot be read"),
        ('"home"', '"rest"', "unfit-sheet", "has no posture 'home'; it has rest"),
    ],
)
def test_a_sheet_that_does_not_speak_of_each_joint_is_told(
    tmp_path: Path, old: str, new: str, name: str, words: str
) -> None:
    assert OWN.count(old) == 1
    (found,) = told(tmp_path, "lab:own-sheet", OWN.replace(old, new))
    assert (found.name, found.severity) == (name, "error")
    assert words in found.message


def test_a_sheet_of_ones_own_is_as_good(tmp_path: Path) -> None:
    assert told(tmp_path, "lab:own-sheet", OWN) == []


def test_of_what_is_told_elsewhere_no_sheet_is_blamed(tmp_path: Path) -> None:
    wrong = OWN.replace("lab:own-sheet a", 'lab:Iiwa-1 skiros:CompliantController "impedence" .\nlab:own-sheet a')
    (tmp_path / "s.ttl").write_text(SCENE.replace('skiros:CompliantController "impedance" ;', "") + wrong, "utf-8")
    (tmp_path / "t.skill").write_text("use skiros\nclass Rag < Product\n", "utf-8")
    (found,) = library_checks.check_library(find_library(tmp_path), tmp_path / "s.ttl")
    assert found.name == "unknown-controller"


@pytest.mark.parametrize(
    ("controller", "arm", "words", "fix"),
    [
        ("forward_dynamics", "skillc:Iiwa14", "gives position commands, and lab:Iiwa-1 takes torque", '"impedance"'),
        ("impedance", "skillc:PositionControlledArm", "lab:Iiwa-1 takes position commands", '"forward_dynamics"'),
        ("forward_dynamics", "skillc:PositionControlledArm", "lab:Iiwa-1 has no skillc:ForceTorqueSensor", None),
        ("on_robot", "skillc:Iiwa14", "lab:Iiwa-1 has no skillc:ForceTorqueSensor", None),
    ],
)
def test_a_controller_that_the_arm_cannot_use_is_told_and_its_sheet_is_not_blamed(
    tmp_path: Path, controller: str, arm: str, words: str, fix: str | None
) -> None:
    own = OWN.replace("skillc:armature", "skillc:admittance 1 ; skillc:rotationalAdmittance 1 ; skillc:armature")
    own = own.replace("skillc:armature", "skillc:admittanceTime 0.03 ; skillc:armature")
    changed = SCENE.replace("lab:Iiwa-1 a skillc:Iiwa14", f"lab:Iiwa-1 a {arm}").replace(
        '"impedance"', f'"{controller}"'
    )
    (tmp_path / "s.ttl").write_text(changed.replace("skillc:iiwa14-sheet", "lab:own-sheet") + own, "utf-8")
    (tmp_path / "t.skill").write_text("use skiros\nclass Rag < Product\n", "utf-8")
    (found,) = library_checks.check_library(find_library(tmp_path), tmp_path / "s.ttl")
    assert (found.name, found.severity) == ("unfit-controller", "error")
    assert words in found.message and (found.fix.text if found.fix else None) == fix


def test_a_law_on_the_robots_side_fits_any_arm_with_a_sensor(tmp_path: Path) -> None:
    changed = SCENE.replace('"impedance"', '"on_robot" ; skillc:hasSensor lab:Wrist-9')
    (tmp_path / "s.ttl").write_text(f"{changed}\nlab:Wrist-9 a skillc:ForceTorqueSensor .\n", "utf-8")
    (tmp_path / "t.skill").write_text("use skiros\nclass Rag < Product\n", "utf-8")
    assert list(library_checks.check_library(find_library(tmp_path), tmp_path / "s.ttl")) == []


def test_what_was_found_does_not_hold_once_a_model_has_changed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own, library = tmp_path / "own", tmp_path / "library"
    (own / "robots").mkdir(parents=True)
    library.mkdir()
    monkeypatch.setenv(catalogue.VARIABLE, str(own))
    sheet = OWN.replace("robots/iiwa14.xml", "robots/mine.xml")
    (missing,) = told(library, "lab:own-sheet", sheet)
    before = compute_digest(find_library(library), library / "s.ttl")
    (own / "robots" / "mine.xml").write_text(catalogue.model_path("robots/iiwa14.xml").read_text("utf-8"), "utf-8")
    assert "no model robots/mine.xml" in missing.message
    assert compute_digest(find_library(library), library / "s.ttl") != before
    assert told(library, "lab:own-sheet", sheet) == []


def test_a_misspelt_home_posture_is_told_at_its_name(tmp_path: Path) -> None:
    (found,) = told(tmp_path, "lab:own-sheet", OWN.replace('"home"', '"hoem"'))
    assert (found.name, found.help) == ("unfit-sheet", "did you mean `home`?")
    assert "has no posture 'home'; it has hoem" in found.message
    line = (tmp_path / "s.ttl").read_text("utf-8").splitlines()[found.span.line - 1]
    assert line[found.span.column - 1 : found.span.end_column - 1] == '"hoem"'
