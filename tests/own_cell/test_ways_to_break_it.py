"""Two parts and two boxes, as somebody writes them who has read the documentation; and ways to get something wrong.

Each way is said in one sentence that names the thing, with numbers and what to do; nothing moves before it is said,
unless nobody could know it.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Literal, NamedTuple

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

FOLDER = Path(__file__).parent / "own"
SIZE = "skiros:SizeX 0.04 ; skiros:SizeY 0.05 ; skiros:SizeZ 0.06 ;"
WEIGHT = "skiros:Weight 0.2 ;"
PLACE = "skillc:on lab:Table ; skillc:atX -0.05 ; skillc:atY -0.3 ."
BOX_PLACE = "skillc:on lab:Table ; skillc:atX -0.05 ; skillc:atY 0.15 ."
BOX = f"skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ;\n    {BOX_PLACE}"
SHEET = "skillc:hasSheet"
WALL_MM = 4
"""The thickness of the walls of a container that states none."""

IDLE = 'skillc:deviceState "Idle" ;'
GOAL = "lab:Box-1 contain lab:Part-1 and lab:Box-2 contain lab:Part-2"
IN_CELL = "skiros:contain lab:Pedestal, lab:Table, lab:Box-1, lab:Box-2, lab:Part-1, lab:Part-2 ."
BRICK = """lab:Brick a own:WorkPart ; skiros:SizeX 0.14 ; skiros:SizeY 0.1 ; skiros:SizeZ 0.05 ;
    skillc:on lab:Table ; skillc:atX -0.05 ; skillc:atY 0.15 ; skillc:atZ 0.004 .

lab:Part-2 a"""
CAMERA = """lab:Camera-1 a skillc:Camera ; skiros:BaseFrameId "map" ; skillc:roll 180 ;
    skiros:PositionX 0.5 ; skiros:PositionY 0.0 ; skiros:PositionZ 1.6 .

lab:Part-2 a"""
Outcome = Literal["invalid", "refused", "failed"]


class Way(NamedTuple):
    """What somebody writes instead of something, what is said about it, how `run` ends, and another such change."""

    before: str
    after: str
    says: str
    ends: Outcome = "refused"
    also: tuple[str, str] | None = None


WAYS = {
    "no size": Way(SIZE, "", "lab:Part-1, a own:WorkPart, has no size, so it has no body"),
    "one size": Way(SIZE, "skiros:SizeX 0.04 ;", "lab:Part-1 is on lab:Table, and has no skiros:SizeY", "invalid"),
    "negative size": Way("SizeX 0.04 ; skiros:SizeY 0.05", "SizeX -0.04 ; skiros:SizeY 0.05", "above 0", "invalid"),
    "decimal comma": Way("SizeX 0.04 ; skiros:SizeY 0.05", "SizeX 0,04 ; skiros:SizeY 0.05", "`0.04`", "invalid"),
    "size as text": Way("SizeX 0.04 ; skiros:SizeY 0.05", 'SizeX "4 cm" ; skiros:SizeY 0.05', "a number", "invalid"),
    "no pose": Way(
        WEIGHT + "\n    " + PLACE, "skiros:Weight 0.2 .", "lab:Part-1 has no pose, so it would be in the mid"
    ),
    "box without size": Way(BOX, BOX_PLACE, "lab:Box-1, a own:Box, has no size, so it has no body: nothing can be put"),
    "box without pose": Way(
        ";\n    " + BOX_PLACE, ".", "lab:Box-1 has no pose, so it would be in the middle of lab:Cell"
    ),
    "box with thick walls": Way(BOX, "skillc:wallThickness 0.09 ; " + BOX, "so there is no room inside"),
    "box too small": Way(BOX, BOX.replace("0.16", "0.04"), "50 x 40 mm do not fit into lab:Box-1, which is 32 x 32 mm"),
    "box upside down": Way(BOX_PLACE, BOX_PLACE[:-1] + "; skillc:roll 180 .", "lab:Box-1 is tilted by 180 deg"),
    "box tilted": Way(
        BOX_PLACE,
        BOX_PLACE[:-1] + "; skillc:roll 15 .",
        "lab:Box-1 is tilted by 15 deg, and no place of 50 x 40 mm on it is clear of lab:Table",
    ),
    "box tilted too far": Way(
        BOX_PLACE,
        BOX_PLACE[:-1] + "; skillc:roll 25 .",
        "tilted by 25 deg, and things stand where it is 20 deg at",
    ),
    "box far away": Way(
        BOX_PLACE,
        "skillc:on lab:Cell ; skillc:atX 0.5 ; skillc:atY 1.5 .",
        "no free place on lab:Box-1 is within the 0.82 m that lab:Arm-1 reaches: the nearest is 1.71 m",
    ),
    "full box": Way(
        "lab:Part-2 a", BRICK, "lab:Box-1 is full: no place of 50 x 40 mm is free beside lab:Brick", "refused"
    ),
    "place without size": Way(
        f"lab:Box-1 a own:Box ;\n    {BOX}",
        f"lab:Box-1 a skiros:Location ;\n    {BOX_PLACE}",
        "lab:Box-1 has no size, and contains nothing that could carry lab:Part-1",
        "refused",
    ),
    "part in the table": Way(PLACE, PLACE[:-1] + "; skillc:atZ -0.1 .", "lab:Part-1 is 100 mm inside lab:Table"),
    "part under the table": Way(PLACE, "skillc:on lab:Cell ; skillc:atX 0.5 .", "lab:Part-1 is 60 mm inside lab:Table"),
    "part beside the table": Way("atY -0.3", "atY -0.6", "lab:Part-1 hangs 600 mm over the floor"),
    "part far away": Way(
        PLACE, "skillc:on lab:Cell ; skillc:atX 3 .", "lab:Part-1 is out of reach of lab:Arm-1 by 2.17 m"
    ),
    "part too heavy": Way(WEIGHT, "skiros:Weight 20 ;", "lab:Part-1 weighs 20 kg, and with 80 N and a friction of 0.6"),
    "part slippery": Way(
        WEIGHT, WEIGHT + " skillc:friction 0 ;", "lab:Part-1 weighs 0.2 kg, and with 80 N and a friction of 0"
    ),
    "part without weight": Way(WEIGHT, "skiros:Weight 0 ;", "it is above 0", "invalid"),
    "part too wide": Way(
        SIZE, SIZE.replace("0.04", "0.14").replace("0.05", "0.15"), "lab:Part-1 is 150 and 140 mm wide"
    ),
    "part wide one way": Way(
        SIZE, SIZE.replace("0.05", "0.25"), "250 x 40 mm do not fit into lab:Box-1, which is 152 x"
    ),
    "part flat": Way(
        SIZE, SIZE.replace("0.06", "0.004"), "lab:Part-1 is 4 mm high as it lies, and the fingers of lab:Han"
    ),
    "part oval": Way(
        "SizeZ 0.06 ; skiros:Weight", 'SizeZ 0.06 ; skillc:shape "cylinder" ; skiros:Weight', "so they must be equal"
    ),
    "part of a wrong class": Way(
        "lab:Part-1 a own:WorkPart",
        "lab:Part-1 a skillc:Furniture",
        "lab:Part-1 is a skillc:Furniture, and Place needs a skiros:Product",
    ),
    "class misspelt": Way(
        "lab:Part-1 a own:WorkPart", "lab:Part-1 a own:Workpart", "there is no class own:Workpart", "invalid"
    ),
    "shape misspelt": Way('"cylinder"', '"cylindre"', "did you mean", "invalid"),
    "on nothing": Way(PLACE, PLACE.replace("Table", "Tabel"), "there is no individual lab:Tabel", "invalid"),
    "in no frame": Way(
        PLACE,
        'skiros:BaseFrameId "no" ; skiros:PositionX 0 ; skiros:PositionY 0 ; skiros:PositionZ 0 .',
        "nothing has this FrameId",
        "invalid",
    ),
    "part in nothing": Way(
        ", lab:Part-1, lab:Part-2", ", lab:Part-2", "Pick needs `a skiros:Location contain lab:Part-1`"
    ),
    "nothing in the cell": Way(IN_CELL, "skiros:contain lab:Table .", "state `lab:Cell skiros:contain lab:Box-1`"),
    "robot nowhere": Way(" ; skiros:at lab:Cell", "", "state `lab:Robot-1 skiros:at lab:Cell`"),
    "robot without arm": Way(" ; skillc:hasArm lab:Arm-1", "", "state `lab:Robot-1 skillc:hasArm lab:Arm-1`"),
    "arm in fault": Way(IDLE, IDLE.replace("Idle", "Fault"), 'lab:Arm-1.deviceState is "Fault"'),
    "arm without hand": Way(" ; skillc:hasGripper lab:Hand-1", "", "state `lab:Arm-1 skillc:hasGripper lab:Hand-1`"),
    "arm without sheet": Way(
        "skillc:hasSheet skillc:iiwa14-sheet ; ", "", "lab:Arm-1 has no skillc:hasSheet", "invalid"
    ),
    "arm without controller": Way(
        'skiros:CompliantController "impedance" ; ', "", "has no skiros:Compliant", "invalid"
    ),
    "hand without sheet": Way(
        "skillc:hasSheet skillc:wsg50-sheet ; ", "", "lab:Hand-1 has no skillc:hasSheet", "invalid"
    ),
    "hand with the sheet of an arm": Way(
        "skillc:wsg50-sheet", "skillc:iiwa14-sheet", "needs a skillc:GripperSheet", "invalid"
    ),
    "camera without sheet": Way("lab:Part-2 a", CAMERA, "lab:Camera-1 has no skillc:hasSheet", "invalid"),
    "goal without a thing": Way(GOAL, "lab:Box-9 contain lab:Part-1", "lab:Box-9"),
    "goal that no skill reaches": Way(
        GOAL, "lab:Box-1 contain lab:Table", "lab:Table is a skillc:Furniture, and Place needs"
    ),
    "goal of two in one small box": Way(
        GOAL, GOAL.replace("Box-2", "Box-1"), "lab:Box-1 is full", "refused", (BOX, BOX.replace("0.16", "0.12"))
    ),
}


def invoke(folder: Path, *arguments: str) -> Result:
    """Run the command line; nothing but its own exit may end it."""
    result = CliRunner().invoke(skillc, [*arguments[:1], *(each.replace("DIR", str(folder)) for each in arguments[1:])])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    assert "Traceback" not in result.output
    return result


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder for all tests, in which the library is compiled again only if a test has changed its text."""
    (folder := tmp_path_factory.mktemp("ways") / "own").mkdir()
    return folder.parent


def written(folder: Path, way: Way | None) -> Path:
    """Write the library, which is named after its folder, with one thing wrong."""
    library, found = folder / "own", 0
    edits = () if way is None else ((way.before, way.after), *((way.also,) if way.also else ()))
    for path in sorted(FOLDER.iterdir()):
        text = path.read_text("utf-8")
        for before, after in edits:
            if before in text:
                text, found = text.replace(before, after, 1), found + 1
        (library / path.name).write_text(text, "utf-8")
    assert found == len(edits)
    return library


@pytest.mark.slow
def test_the_cell_works_at_the_first_run(place: Path) -> None:
    library = written(place, None)
    assert "no problems" in invoke(library, "check", "DIR").output
    answer = json.loads(invoke(library, "run", "DIR:sort", "--backend", "kinematic", "--json").stdout)
    assert answer["status"] == "succeeded", answer["failure"]


@pytest.mark.slow
@pytest.mark.parametrize("name", WAYS)
def test_what_is_wrong_is_said(name: str, place: Path) -> None:
    way = WAYS[name]
    library = written(place, way)
    result = invoke(library, "run", "DIR:sort", "--backend", "kinematic", "--json")
    if way.ends == "invalid":
        assert result.exit_code == 1 and way.says in result.stderr, result.stderr
        return
    answer = json.loads(result.stdout)
    assert (result.exit_code, answer["status"]) == (3, way.ends), answer["failure"]
    assert way.says in answer["failure"]
    vague = r"there is no plan|cannot be reached|no implementation of|individuals of \S+ fits"
    assert not re.search(vague, answer["failure"])
    parts = re.split("; |\n", answer["failure"])
    assert len(parts) == len(set(parts)), "nothing is said twice"


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, way in WAYS.items() if way.ends != "failed"])
def test_check_says_the_same(name: str, place: Path) -> None:
    result = invoke(written(place, WAYS[name]), "check", "DIR")
    assert result.exit_code == 1 and WAYS[name].says in result.output


@pytest.mark.slow
@pytest.mark.parametrize(("height", "more_mm", "fits"), [(0.06, 0, True), (0.06, -2, False), (0.12, 0, True)])
def test_a_box_of_the_size_that_is_said_fits(height: float, more_mm: int, fits: bool, place: Path) -> None:
    def said(x_mm: int, y_mm: int) -> str:
        x, y = (f"skiros:Size{axis} {(mm + 2 * WALL_MM) / 1e3:g}" for axis, mm in (("X", x_mm), ("Y", y_mm)))
        size = BOX.replace("skiros:SizeX 0.16 ; skiros:SizeY 0.16", f"{x} ; {y}").replace("0.06", f"{height:g}")
        return invoke(written(place, Way(BOX, size, "")), "check", "DIR").output

    needed = re.search(r"with room for the hand they need (\d+) x (\d+) mm", said(32, 32))
    assert needed is not None
    x_mm, y_mm = map(int, needed.groups())
    assert ("do not fit into" not in said(x_mm + more_mm, y_mm + more_mm)) == fits


@pytest.mark.slow
def test_what_a_device_contradicts_is_the_reason(place: Path) -> None:
    library = written(place, WAYS["part in nothing"])
    cell = (library / "cell.ttl").read_text("utf-8")
    held = cell.replace(f"\n    {PLACE}", "").replace(WEIGHT, "skiros:Weight 0.2 .", 1)
    held = held.replace('skiros:FrameId "hand" ;', 'skiros:FrameId "hand" ; skiros:contain lab:Part-1 ;')
    (library / "cell.ttl").write_text(held, "utf-8")
    answer = json.loads(invoke(library, "run", "DIR:sort", "--backend", "kinematic", "--json").stdout)
    lead = "`lab:Hand-1 contain lab:Part-1` does not hold any more: lab:Hand-1 reports that it holds nothing"
    assert (answer["status"], answer["failure"]) == ("failed", f"{lead}; no other plan was found")
    assert "pre `held: gripper contain object` does not hold" in json.dumps(answer["cause"])
