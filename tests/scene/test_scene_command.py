"""`skillc scene`: what is written is what a person would write, and everything else in the file stays."""

from __future__ import annotations

import json
import random
from difflib import ndiff
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc.errors import RequestError
from skillc.services.library.libraries import load_vocabulary
from skillc.services.scene.sheets import find_sheet
from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.platforms import gl
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.world.space.shape.outlines import convex_hull

CELL = """\
# A table, two things on it.
@prefix lab:    <http://example.org/lab#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Cell a skiros:Scene ; skiros:contain lab:Here .
lab:Here a skillc:Workstation ; skillc:on lab:Cell ;   # the floor
    skiros:FrameId "here" .

lab:Table-1 a skillc:Furniture ;
    skiros:SizeX 0.8 ; skiros:SizeY 0.6 ; skiros:SizeZ 0.7 ;
    skillc:on lab:Here .

# The part that is moved about.
lab:Part-A a skiros:Product ;
    skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.06 ; # from the drawing
    skillc:on lab:Table-1 ; skillc:atX 0.20 ; skillc:atY 0.10 .

lab:Part-B a skiros:Product ;
    skiros:BaseFrameId "here" ; skiros:PositionX 2 ; skiros:PositionY 0 ; skiros:PositionZ 1 ;
    skiros:OrientationW 1 ; skiros:OrientationX 0 ; skiros:OrientationY 0 ; skiros:OrientationZ 0 .
"""


@pytest.fixture
def cell(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a scene in the current folder; its pictures, which cost most of the time of `show`, are not rendered."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(gl, "PLATFORMS", {})
    path = Path("cell.ttl")
    path.write_text(CELL, "utf-8")
    return path


def scene(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, ["scene", *arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def change(path: Path, *arguments: str) -> list[str]:
    """Return the lines that a command removes and adds, with their sign."""
    before = path.read_text("utf-8").splitlines()
    result = scene(arguments[0], str(path), *arguments[1:])
    assert result.exit_code == 0, result.stderr
    return [line for line in ndiff(before, path.read_text("utf-8").splitlines()) if line[0] in "+-"]


def shown(path: Path) -> dict[str, dict[str, list[float]]]:
    return {each["name"]: each for each in json.loads(scene("show", str(path), "--json").stdout)}


def test_a_thing_is_added_at_the_end(cell: Path) -> None:
    added = change(cell, "add", "Box-1", "Container", "--size", "0.30", "0.2", "0.1", "--on", "Table-1")
    added += change(cell, "move", "Box-1", "--corner", "--at", "0.20", "0.150", "--yaw", "-90")
    assert cell.read_text("utf-8") == (
        f"{CELL}\nlab:Box-1 a skiros:Container ;\n    skiros:SizeX 0.30 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.1 ;\n"
        '    skillc:on lab:Table-1 ; skillc:anchor "corner" ; skillc:atX 0.20 ; skillc:atY 0.150 ; skillc:yaw -90 .\n'
    )
    box = shown(cell)["lab:Box-1"]
    assert (box["position"], box["angles"]) == ([-0.2, -0.15, 0.75], [0.0, 0.0, -90.0])


@pytest.mark.slow
def test_a_thing_of_which_nothing_says_where_it_is_stands_on_the_floor_of_the_only_workstation(tmp_path: Path) -> None:
    path = tmp_path / "own.ttl"
    assert scene("new", str(path), "--arm", "Panda").exit_code == 0
    assert (
        scene("add", str(path), "Table", "Furniture", "--size", "0.8", "1.0", "0.6", "--at", "0.6", "0").exit_code == 0
    )
    assert shown(path)["lab:Table"]["position"] == [0.6, 0.0, 0.6]
    unknown = scene("move", str(path), "Foo", "--at", "0", "0").stderr
    assert "there is lab:Arm-1, lab:Cell, lab:Gripper-1" in unknown and "sheet" not in unknown
    path.write_text(path.read_text("utf-8") + "\nlab:Other a skillc:Workstation ; skillc:on lab:Scene-1 .\n", "utf-8")
    between = scene("add", str(path), "Box", "Container", "--size", "0.2", "0.2", "0.1")
    assert (between.exit_code, between.stdout) == (2, "") and "say where it is: --on THING" in between.stderr


def test_what_a_thing_needs_is_declared_and_its_place_contains_it(cell: Path) -> None:
    options = (
        "--label",
        "a cup",
        "--weight",
        "0.2",
        "--shape",
        "cylinder",
        "--in",
        "Here",
        "--position",
        "1",
        "0",
        ".5",
    )
    lines = change(cell, "add", "lab:Cup-1", "skiros:Product", *options)
    assert "+ @prefix rdfs:   <http://www.w3.org/2000/01/rdf-schema#> ." in lines
    assert '+ lab:Cup-1 a skiros:Product ; rdfs:label "a cup" ;' in lines
    assert '+     skiros:Weight 0.2 ; skillc:shape "cylinder" ;' in lines
    assert "+     skiros:contain lab:Cup-1 ;" in lines
    assert not [line for line in lines if line.startswith("-")]
    assert shown(cell)["lab:Cup-1"]["position"] == [1.0, 0.0, 0.5]


def test_moving_changes_only_the_pose(cell: Path) -> None:
    on = "    skillc:on lab:Table-1 ; "
    assert change(cell, "move", "Part-A", "--at", "0.25", "-0.1") == [
        f"- {on}skillc:atX 0.20 ; skillc:atY 0.10 .",
        f"+ {on}skillc:atX 0.25 ; skillc:atY -0.1 .",
    ]
    assert change(cell, "move", "Part-A", "--yaw", "30") == [
        f"- {on}skillc:atX 0.25 ; skillc:atY -0.1 .",
        f"+ {on}skillc:atX 0.25 ; skillc:atY -0.1 ; skillc:yaw 30 .",
    ]
    assert change(cell, "move", "Part-A", "--on", "Table-1", "--yaw", "40") == [
        f"- {on}skillc:atX 0.25 ; skillc:atY -0.1 ; skillc:yaw 30 .",
        f"+ {on}skillc:atX 0.25 ; skillc:atY -0.1 ; skillc:yaw 40 .",
    ]
    place = 'skiros:BaseFrameId "map" ; skiros:PositionX 1 ; skiros:PositionY 2 ; skiros:PositionZ 3'
    assert change(cell, "move", "Part-A", "--position", "1", "2", "3")[1:] == [f"+     skillc:yaw 40 ; {place} ."]


@pytest.mark.slow
def test_a_thing_in_a_frame_moves_in_it_and_from_it(cell: Path) -> None:
    change(cell, "move", "Part-B", "--position", "1", "0", "0.5")
    assert shown(cell)["lab:Part-B"]["stated"] == "in here"
    lines = change(cell, "move", "Part-B", "--yaw", "90")
    assert len([line for line in lines if "Orientation" in line and line[0] == "+"]) == 0
    change(cell, "move", "Part-B", "--on", "Table-1", "--face", "front")
    placed = shown(cell)["lab:Part-B"]
    assert (placed["position"], placed["angles"]) == ([0.4, 0.0, 0.35], [0.0, 0.0, 90.0])
    assert "Position" not in cell.read_text("utf-8").partition("lab:Part-B")[2]


def test_things_are_removed_and_everything_else_stays(cell: Path) -> None:
    block = CELL[CELL.index("lab:Part-A") : CELL.index("lab:Part-B")]
    lines = change(cell, "remove", "Part-A")
    assert [line[2:] for line in lines] == block.rstrip().splitlines() and all(line[0] == "-" for line in lines)
    result = scene("remove", "cell.ttl", "Table-1", "Part-B")
    assert result.stderr == "cell.ttl: lab:Table-1, lab:Part-B removed\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "code", "reason"),
    [
        (("add", "Part-A", "Product"), 1, "in the scene already"),
        (("add", "Part C", "Product"), 1, "cannot be a name"),
        (("add", "zoo:C", "Product"), 1, "`zoo:` is not declared"),
        (("add", "C", "Prodct"), 1, "did you mean skiros:Product"),
        (("add", "C", "Product", "--on", "Tabel-1"), 1, "did you mean lab:Table-1"),
        (("add", "C", "Product", "--on", "Part-B"), 1, "which has no skiros:SizeX"),
        (("add", "C", "Product", "--on", "Table-1", "--position", "0", "0", "0"), 2, "not both"),
        (("add", "C", "Product", "--size", "a", "1", "1"), 2, "'a' is not a number"),
        (("add", "C", "Product", "--size", "-1", "1", "1", "--on", "Table-1"), 1, "SizeX"),
        (("move", "Part-A"), 2, "say where to"),
        (("move", "Part-B", "--at", "1", "1"), 1, "lab:Part-B is on nothing"),
        (("move", "Table-1", "--on", "Part-A"), 1, "is asymmetric"),
        (("remove", "Table-1"), 1, "lab:Part-A is on lab:Table-1: move it or remove it, too"),
        (("remove", "Zebra"), 1, "no individual lab:Zebra"),
    ],
)
def test_what_makes_no_sense_changes_nothing(cell: Path, arguments: tuple[str, ...], code: int, reason: str) -> None:
    result = scene(arguments[0], "cell.ttl", *arguments[1:])
    assert (result.exit_code, result.stdout) == (code, "") and reason in result.stderr
    assert cell.read_text("utf-8") == CELL


@pytest.mark.parametrize("ends", ["\r\n", "\n"])
def test_line_ends_stay(cell: Path, ends: str) -> None:
    cell.write_bytes(CELL.replace("\n", ends).encode())
    assert scene("move", "cell.ttl", "Part-A", "--at", "0.25", "0.10").exit_code == 0
    assert cell.read_bytes() == CELL.replace("atX 0.20", "atX 0.25").replace("\n", ends).encode()


@pytest.mark.slow
@pytest.mark.parametrize("arm", [None, "ur5e", "PANDA"])
def test_a_new_scene_is_valid_and_can_be_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arm: str | None
) -> None:
    monkeypatch.chdir(tmp_path)
    assert scene("new", "own/cell.ttl", *(("--arm", arm) if arm else ())).exit_code == 0
    assert CliRunner().invoke(skillc, ["world", "own/cell.ttl"]).stderr == ""
    assert ("lab:Arm-1" in shown(Path("own/cell.ttl"))) == (arm is not None)
    again = scene("new", "own/cell.ttl")
    assert again.exit_code == 2 and "already" in again.stderr
    assert "there is Iiwa14" in scene("new", "b.ttl", "--arm", "robby").stderr
    assert scene("new", "b.owl").exit_code == 2 and not Path("b.ttl").exists()


def test_the_view_from_above_shows_each_thing_to_scale(cell: Path) -> None:
    result = scene("show", "cell.ttl", "--out", "pictures")
    assert result.exit_code == 0 and "lab:Part-A" in result.stdout
    assert "in here" in result.stdout and "pictures/cell.svg" in result.stderr
    drawing = ElementTree.parse("pictures/cell.svg")
    outlines = {each[0].text: each.get("points", "") for each in drawing.iter() if each.tag.endswith("polygon")}
    assert outlines.keys() == {"lab:Table-1", "lab:Part-A"}
    table, part = (np.array([p.split(",") for p in outlines[n].split()], float) for n in ("lab:Table-1", "lab:Part-A"))
    scale = np.ptp(table[:, 0]) / 0.8
    assert np.allclose(np.ptp(table, axis=0), np.array([0.8, 0.6]) * scale, atol=0.2)
    assert np.allclose(part.mean(axis=0) - table.mean(axis=0), np.array([0.2, -0.1]) * scale, atol=0.2), "y is up"
    first = Path("pictures/cell.svg").read_bytes()
    scene("show", "cell.ttl", "--out", "pictures")
    assert Path("pictures/cell.svg").read_bytes() == first


def test_without_a_graphics_library_it_says_so_and_draws_from_above(cell: Path) -> None:
    result = scene("show", "cell.ttl")
    assert result.exit_code == 0 and "no PNG: no GL library draws off screen" in result.stderr
    assert [each.name for each in Path("out/scene").iterdir()] == ["cell.svg"]


@pytest.mark.slow
def test_random_edits_keep_comments_and_all_other_statements(cell: Path) -> None:
    chance, done = random.Random(15), 0
    others = [line for line in CELL.splitlines() if line.startswith(("#", "@prefix", "lab:Cell", "lab:Here"))]
    for _ in range(10):
        x, y, yaw = (f"{chance.uniform(-0.3, 0.3):.2f}" for _ in range(3))
        place = chance.choice((("--on", "Table-1", "--at", x, y), ("--position", x, y, "1"), ("--at", x, y), ()))
        turn = chance.choice(((), ("--yaw", yaw), ("--roll", yaw, "--pitch", "0")))
        done += scene("move", "cell.ttl", chance.choice(("Part-A", "Part-B")), *place, *turn).exit_code == 0
        text = cell.read_text("utf-8")
        assert all(line in text.splitlines() for line in others) and text.count("# from the drawing") == 1
        assert scene("show", "cell.ttl", "--json").exit_code == 0
    assert done > 3


def test_a_thing_is_in_the_place_of_what_it_stands_on(cell: Path) -> None:
    size = ("--size", "0.04", "0.04", "0.06")
    lone = scene("add", str(cell), "Part-C", "Product", *size, "--on", "Table-1")
    assert "lab:Part-C added; no place contains it, so no skill finds it: say --in PLACE" in lone.stderr
    on_floor = scene("add", str(cell), "Table-2", "Furniture", *size, "--on", "Here", "--at", "2", "0")
    assert "lab:Table-2 added, in lab:Here" in on_floor.stderr
    assert "in lab:Here" in scene("add", str(cell), "Part-D", "Product", *size, "--on", "Table-2").stderr
    assert cell.read_text("utf-8").count("skiros:contain lab:Table-2, lab:Part-D") == 1
    robot = change(cell, "add", "Robot-1", "FixedRobot", "--on", "Here")
    assert not any("contain" in line for line in robot)


def test_the_hull_of_points_has_all_of_them_inside() -> None:
    points = np.random.default_rng(4).normal(size=(60, 2))
    hull = convex_hull(points)
    edges = np.roll(hull, -1, axis=0) - hull
    for start, edge in zip(hull, edges, strict=True):
        away = points - start
        assert (edge[0] * away[:, 1] - edge[1] * away[:, 0] > -1e-6).all()
    assert 3 <= len(hull) < 60


def test_a_device_gets_the_data_sheet_of_its_class(cell: Path) -> None:
    added = scene("add", "cell.ttl", "Camera-1", "Camera", "--on", "Table-1", "--at-z", "1", "--roll", "180")
    assert added.exit_code == 0, added.output
    assert "lab:Camera-1 a skillc:Camera ; skillc:hasSheet skillc:depth-camera-sheet ;" in cell.read_text("utf-8")
    tool = ("add", "cell.ttl", "Tool-1", "Tool", "--size", "0.1", "0.05", "0.03", "--weight", "0.1", "--on", "Table-1")
    unnamed = scene(*tool).output
    assert "a skillc:Tool needs a data sheet: name it with `--sheet NAME`; there is " in unnamed
    assert "wiping:eraser-sheet" in unnamed and "contact:peg-sheet" in unnamed and "depth-camera" not in unnamed
    unknown = scene(*tool, "--sheet", "nowhere-sheet")
    assert unknown.exit_code == 2 and "no data sheet `nowhere-sheet`; there is contact:button-sheet, " in unknown.output
    assert "did you mean `wiping:eraser-sheet`?" in scene(*tool, "--sheet", "wiping:erase-sheet").output
    assert scene(*tool, "--sheet", "Table-1").exit_code == 2
    assert scene(*tool, "--sheet", "eraser-sheet").exit_code == 0
    assert "skillc:hasSheet wiping:eraser-sheet" in cell.read_text("utf-8")


@pytest.mark.parametrize(
    ("cls", "sheet"),
    [
        ("Panda", "skillc:panda-sheet"),
        ("PandaHand", "skillc:panda-hand-sheet"),
        ("Heron", "skillc:heron-sheet"),
        ("Eraser", "wiping:eraser-sheet"),
        ("InspectionCamera", "skillc:inspection-camera-sheet"),
        ("MobileRobot", "skillc:heron-sheet"),
        ("Peg", "contact:peg-sheet"),
        ("Furniture", ""),
    ],
)
def test_a_thing_has_the_shipped_sheet_of_its_class_without_naming_it(cls: str, sheet: str) -> None:
    state = load_sheets(load_vocabulary())
    (iri,) = (each for each in state.vocabulary.classes if local_name(each) == cls)
    assert state.vocabulary.short(find_sheet(iri, None, state) or "") == sheet


def test_the_sheets_of_its_kind_are_listed_where_a_class_has_several() -> None:
    state = load_sheets(load_vocabulary())
    (gripper,) = (each for each in state.vocabulary.classes if local_name(each) == "WsgGripper")
    with pytest.raises(RequestError, match="panda-hand-sheet, skillc:robotiq-3f-sheet, skillc:wsg50-sheet"):
        find_sheet(gripper, None, state)


def test_a_rack_has_its_slots_in_a_grid_on_its_floor(cell: Path) -> None:
    arguments = ("add", str(cell), "Rack-1", "Container", "--size", "0.308", "0.208", "0.06", "--on", "Table-1")
    assert scene(*arguments, "--slots", "3", "2").exit_code == 0
    text = cell.read_text("utf-8")
    assert text.count("a skiros:PlacingPose") == 6 and 'skiros:FrameId "rack_1"' in text
    found = json.loads(scene("show", str(cell), "--json").stdout)
    places = {each["name"]: each for each in found if "slot" in each["name"]}
    rack = next(each for each in found if each["name"] == "lab:Rack-1")
    assert len(places) == 6
    offsets = {name: np.subtract(each["position"], rack["position"]) for name, each in places.items()}
    assert offsets["lab:Rack-1-slot-1-1"] == pytest.approx([-0.1, -0.05, 0.004 - 0.03])
    assert offsets["lab:Rack-1-slot-3-2"] == pytest.approx([0.1, 0.05, 0.004 - 0.03])
    for more, words in (
        (("R2", "Container", "--size", "0.2", "0.2", "0.06", "--slots", "0", "2"), "whole numbers from 1"),
        (("R2", "Furniture", "--size", "0.2", "0.2", "0.06", "--slots", "1", "2"), "is no skiros:Container"),
        (("R2", "Container", "--slots", "1", "2"), "--slots needs the size"),
    ):
        refused = scene("add", str(cell), *more, "--on", "Table-1")
        assert refused.exit_code == 2 and words in refused.stderr, refused.output
    assert cell.read_text("utf-8") == text
