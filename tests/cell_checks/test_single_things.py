"""Single things, each with facts that are right and with such that are not."""

from __future__ import annotations

from pathlib import Path

import pytest

from cell_checks.test_random_cells import problems

HEAD = """
@prefix lab:     <http://example.org/lab#> .
@prefix contact: <https://w3id.org/skillc/contact#> .
@prefix skillc:  <https://w3id.org/skillc/core#> .
@prefix skiros:  <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Floor a skiros:Scene .
lab:Table a skillc:Furniture ; skillc:on lab:Floor ; skiros:SizeX 0.6 ; skiros:SizeY 0.6 ; skiros:SizeZ 0.7 .
"""
CUBE = "skiros:SizeX 0.05 ; skiros:SizeY 0.05 ; skiros:SizeZ 0.05"
PLANK = "skiros:SizeX 0.5 ; skiros:SizeY 0.05 ; skiros:SizeZ 0.02"
BIN = """lab:Bin a skiros:Container ; skillc:on lab:Table ;
    skiros:SizeX 0.2 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.1 ; skillc:wallThickness 0.005 ; skiros:FrameId "bin" .
"""
IN_BIN = """lab:Part a skiros:Product ; {cube} ; skiros:BaseFrameId "bin" ; skillc:yaw 0 ;
    skiros:PositionX {x} ; skiros:PositionY 0 ; skiros:PositionZ -0.02 .
"""
SHELF = """lab:Shelf a skillc:Furniture ; skillc:shape "shelf" ; skillc:boards 3 ; skillc:on lab:Floor ; skillc:atX 2 ;
    skiros:FrameId "shelf" ; skiros:SizeX 0.3 ; skiros:SizeY 0.6 ; skiros:SizeZ 1.0 ; skillc:wallThickness 0.02 .
"""
BLOCKS = """lab:Left a skillc:Furniture ; skillc:on lab:Floor ; skillc:atX 1.8 ; {cube} .
lab:Right a skillc:Furniture ; skillc:on lab:Floor ; skillc:atX {x} ; {cube} .
"""
PLACING = """lab:Place a skiros:Location ; skiros:hasA lab:Placing .
lab:Placing a skiros:PlacingPose ; skiros:BaseFrameId "map" ; skillc:roll 180 ;
    skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ {z} .
"""
PEG = """lab:Peg a contact:Peg ; skillc:hasSheet contact:peg-sheet ; contact:isSeated false ; skillc:on lab:Table ;
    skiros:SizeX 0.02 ; skiros:SizeY 0.02 ; skiros:SizeZ {z} ; skiros:Weight {kg} ; skillc:graspWidth {width} .
"""


LID = """lab:Lid a skiros:Product ; skiros:SizeX {x} ; skiros:SizeY 0.06 ; skiros:SizeZ 0.02 ;
    skillc:on lab:Bin ; skillc:face "top" .
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (BIN + LID.format(x=0.21), None),
        (BIN + LID.format(x=0.15), "lab:Lid hangs 95 mm over lab:Bin"),
        (BIN + IN_BIN.format(cube=CUBE, x=0), None),
        (BIN + IN_BIN.format(cube=CUBE, x=0.08), "lab:Part is 5 mm inside lab:Bin|lab:Part is 10 mm inside lab:Bin"),
        (BLOCKS.format(cube=CUBE, x=2.2) + f"lab:Plank a skiros:Product ; {PLANK} ; skillc:on lab:Floor ;\n"
         "    skillc:atX 2 ; skillc:atZ 0.05 .\n", None),
        (BLOCKS.format(cube=CUBE, x=1.9) + f"lab:Plank a skiros:Product ; {PLANK} ; skillc:on lab:Floor ;\n"
         "    skillc:atX 2 ; skillc:atZ 0.05 .\n", "is at least 69 mm beyond lab:Right"),
        (PLACING.format(z=0.71), None),
        (PLACING.format(z=0.75), "nothing supports what is put at lab:Placing: lab:Table is 50 mm below it"),
        (PLACING.format(z=0.6), "the pose lab:Placing is 100 mm inside lab:Table"),
        (PLACING.format(z=1.0), "nothing supports what is put at lab:Placing: lab:Table is 300 mm below it"),
        (PEG.format(z=0.06, kg=0.2, width=0.02), None),
        (PEG.format(z=0.07, kg=0.2, width=0.02), "lab:Peg.skiros:SizeZ is 0.07 m, and its model in contact:peg-sheet"),
        (PEG.format(z=0.06, kg=0.3, width=0.02), "lab:Peg.skiros:Weight is 0.3 kg"),
        (PEG.format(z=0.06, kg=0.2, width=0.04), "lab:Peg.skillc:graspWidth is 0.04 m"),
        (f'lab:Can a skiros:Product ; skillc:shape "cylinder" ; {CUBE} ;\n'
         "    skillc:on lab:Table ; skillc:roll 90 .", None),
        (f"lab:A a skiros:Product ; {CUBE} ; skillc:on lab:Table .\n"
         f"lab:B a skiros:Product ; {CUBE} ; skillc:on lab:A .", None),
        (f"lab:A a skiros:Product ; {CUBE} ; skillc:on lab:Table .\n"
         f"lab:B a skiros:Product ; {CUBE} ; skillc:on lab:A ; skillc:atX 0.045 .", "lab:B tips over"),
    ],
)  # fmt: skip
def test_a_thing_is_checked(text: str, expected: str | None, tmp_path: Path) -> None:
    found = [each.message for each in problems(HEAD + text, tmp_path)]
    assert len(found) == (expected is not None), found
    assert expected is None or any(part in found[0] for part in expected.split("|")), found


@pytest.mark.parametrize(("z", "right"), [(-0.465, True), (-0.44, False)])
def test_a_part_on_a_shelf_stands_on_its_board(z: float, right: bool, tmp_path: Path) -> None:
    part = f'lab:Part a skiros:Product ; {CUBE} ; skiros:BaseFrameId "shelf" ; skillc:yaw 0 ;\n'
    part += f"    skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ {z} .\n"
    found = [each.message for each in problems(HEAD + SHELF + part, tmp_path)]
    assert (found == []) is right, found


@pytest.mark.parametrize(("severity", "height"), [("warning", 0.04), ("error", 0.06)])
def test_what_a_task_uses_is_an_error_beyond_the_distance_by_which_things_may_be_elsewhere(
    severity: str, height: float, tmp_path: Path
) -> None:
    part = f"lab:Part a skiros:Product ; {CUBE} ; skillc:on lab:Table ; skillc:atZ {height} .\n"
    (found,) = problems(HEAD + part, tmp_path, "Part")
    assert (found.name, found.severity) == ("no-support", severity)
    (unused,) = problems(HEAD + part, tmp_path)
    assert unused.severity == "warning"
