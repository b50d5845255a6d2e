"""If no plan goes, the answer says of each place of the goal that is full or blocked what is in the way there."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from refinement.mat_cell import SCENE
from skillc.cli.main import skillc

BOTH = "lab:Box-A contain lab:Part-A and lab:Box-B contain lab:Part-B"
BOXES = """
lab:Box-A a skiros:Container ; skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;
    skillc:on lab:Table ; skillc:atX -0.3 ; skillc:atY 0.3 .
lab:Box-B a skiros:Container ; skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;
    skillc:on lab:Table ; skillc:atX -0.1 ; skillc:atY 0.4 .
"""
LUMP = ("Lump", (0.1, 0.1, 0.05), (0.65, 0.4, 0.63))
"""What fills box B."""

BOARD = ("Board", (0.2, 0.2, 0.02), (0.4, 0.28, 0.75))
"""What is over box A."""

FREE = "cannot be put down: no place of 40 x 40 mm on"


def write_boxes(folder: Path, *fixed: tuple[str, tuple[float, ...], tuple[float, ...]]) -> Path:
    """Write the cell with two boxes and things that nobody can move."""
    names = ["Box-A", "Box-B", *(name for name, _, _ in fixed)]
    text = SCENE.format(more="".join(f", lab:{name}" for name in names)) + BOXES
    for name, size, at in fixed:
        sizes = " ; ".join(f"skiros:Size{axis} {value}" for axis, value in zip("XYZ", size, strict=True))
        place = " ; ".join(f"skiros:Position{axis} {value}" for axis, value in zip("XYZ", at, strict=True))
        text += f'lab:{name} a skillc:Furniture ; {sizes} ; skiros:BaseFrameId "map" ; {place} .\n'
    path = folder / "cell.ttl"
    path.write_text(text)
    return path


def ask(command: str, scene: Path, *options: str) -> Result:
    asked = [command, "--library", "sorting", "--scene", str(scene), "--goal", BOTH, *options]
    return CliRunner().invoke(skillc, asked)


@pytest.mark.slow
def test_of_two_places_that_are_blocked_both_are_named(tmp_path: Path) -> None:
    scene = write_boxes(tmp_path, LUMP, BOARD)
    for command, options in (("plan", ("--no-plan-cache",)), ("run", ("--no-film",))):
        ran = ask(command, scene, *options)
        assert ran.exit_code == 3
        assert f"lab:Part-A {FREE} lab:Box-A is clear of lab:Board" in ran.output
        assert f"lab:Part-B {FREE} lab:Box-B is clear of lab:Lump" in ran.output


@pytest.mark.slow
def test_a_place_that_is_free_is_not_named(tmp_path: Path) -> None:
    ran = ask("plan", write_boxes(tmp_path, LUMP), "--no-plan-cache")
    assert ran.exit_code == 3 and ran.output.count("cannot be put down") == 1
    assert f"lab:Part-B {FREE} lab:Box-B is clear of lab:Lump" in ran.output


@pytest.mark.slow
def test_a_plan_is_as_it_was(tmp_path: Path) -> None:
    ran = ask("plan", write_boxes(tmp_path), "--no-plan-cache", "--json")
    assert ran.exit_code == 0 and json.loads(ran.stdout)["space"]["checked"] == 4
