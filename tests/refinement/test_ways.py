"""A base drives around what stands in its way; what blocks all ways is said before anything moves."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from refinement.scenes import two_bases
from simulation.cells import LAB, world
from skillc.cli.main import skillc
from skillc_ontology import catalogue
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.world.space.base_ways import BaseWay, BlockedWay, find_base_way
from skillc_runtime.world.space.floor_plan import FloorPlan
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.state.terms import FURNITURE
from space.rooms import at, thing

PICKED = "lab:Wsg-1 contain lab:Eraser-1"
ROBOT, DOCK, STORE = LAB + "Heron-1", LAB + "Dock", LAB + "Store"
ACROSS = [("Rack", (0.75, -0.6), (0.2, 2.0))]
AROUND = [
    ("Wall-1", (0.9, -0.7), (0.1, 3.4)),
    ("Wall-2", (-1.1, -0.7), (0.1, 3.4)),
    ("Wall-3", (-0.1, 1.1), (2.1, 0.1)),
    ("Wall-4", (-0.1, -2.5), (2.1, 0.1)),
]
"""Walls around the dock, where the robot is."""

TASK = """
use skiros
prefix lab: <http://example.org/lab#>
import "handling.skill"
import "driving.skill"

task fetch {
    scene "cell.ttl"
    goal  lab:Wsg-1 contain lab:Eraser-1
}
"""

Box = tuple[str, tuple[float, float], tuple[float, float]]


def write_cell(folder: Path, boxes: list[Box]) -> Path:
    """Write the cell of the UR5e on a base with furniture of 0.8 m at places on the floor."""
    text = catalogue.scene_path("ur5e_whiteboard").read_text()
    stands = "skiros:contain lab:Dock,"
    assert stands in text
    text = text.replace(stands, " ".join((stands, *(f"lab:{name}," for name, _, _ in boxes))))
    for name, (x, y), (long, wide) in boxes:
        text += f"""
lab:{name} a skillc:Furniture ; skiros:SizeX {long} ; skiros:SizeY {wide} ; skiros:SizeZ 0.8 ;
    skiros:BaseFrameId "map" ; skiros:PositionX {x} ; skiros:PositionY {y} ; skiros:PositionZ 0.4 .
"""
    path = folder / "cell.ttl"
    path.write_text(text)
    return path


def ask(command: str, scene: Path, *options: str) -> dict:
    asked = [command, "--library", "wiping", "--scene", str(scene), "--goal", PICKED, "--json", *options]
    return json.loads(CliRunner().invoke(skillc, asked).stdout)


def find_way(boxes: list[Box]) -> BaseWay | BlockedWay:
    state = world("ur5e_whiteboard")
    changes = [
        each
        for name, (x, y), (long, wide) in boxes
        for each in thing(name, at(x, y, 0.4), size=(long, wide, 0.8), cls=FURNITURE)
    ]
    state = state.with_changes(changes)
    start = pose(state, DOCK)
    return find_base_way(FloorPlan(state, ROBOT, start), start, pose(state, STORE))


def test_the_straight_way_is_taken_where_it_is_free() -> None:
    way = find_way([])
    assert isinstance(way, BaseWay) and len(way.poses) == 1 and way.around == ()


def test_low_things_under_a_table_and_what_hangs_over_the_base_are_not_in_the_way() -> None:
    state = world("ur5e_whiteboard")
    lamp = thing("Lamp", at(0.75, -0.6, 1.5), size=(0.5, 0.5, 0.2), cls=FURNITURE)
    start = pose(state, DOCK)
    plan = FloorPlan(state.with_changes(lamp), ROBOT, start)
    way = find_base_way(plan, start, pose(state, STORE))
    assert isinstance(way, BaseWay) and len(way.poses) == 1


def test_a_way_around_touches_nothing_as_exact_boxes_tell() -> None:
    """Its poses are compared with the boxes of the things by the corners of both, as rectangles."""
    way = find_way(ACROSS)
    assert isinstance(way, BaseWay) and len(way.poses) > 1 and way.around == (LAB + "Rack",)
    rack = _rectangle(0.75, -0.6, 0.0, 0.2, 2.0)
    at_, looked = np.array([0.0, 0.0]), 0
    for there in way.poses:
        leg = there.position[:2] - at_
        heading = float(np.arctan2(leg[1], leg[0]))
        for share in np.linspace(0.0, 1.0, 50):
            base = _rectangle(*(at_ + share * leg), heading, 0.7, 0.5)
            assert _gap(base, rack) > -0.003
            looked += 1
        at_ = there.position[:2]
    assert looked >= 100


def _rectangle(x: float, y: float, heading: float, long: float, wide: float) -> np.ndarray:
    corners = np.array([(a * long / 2, b * wide / 2) for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))])
    return corners @ exp(np.array([0.0, 0.0, heading]))[:2, :2].T + (x, y)


def _gap(one: np.ndarray, other: np.ndarray) -> float:
    """Return the greatest gap of two rectangles along one of their sides."""
    gaps = []
    for corners in (one, other):
        for side in (corners[1] - corners[0], corners[2] - corners[1]):
            along = side / np.linalg.norm(side)
            first, second = one @ along, other @ along
            gaps.append(max(second.min() - first.max(), first.min() - second.max()))
    return max(gaps)


def test_what_blocks_all_ways_is_found() -> None:
    way = find_way(AROUND)
    assert isinstance(way, BlockedWay) and not way.at_goal
    assert len(way.by) == 1 and way.by[0].startswith(LAB + "Wall-"), "without one wall there is a way"
    assert isinstance(find_way([each for each in AROUND if LAB + each[0] not in way.by]), BaseWay)


def test_what_stands_at_the_goal_is_named() -> None:
    way = find_way([("Crate", (1.5, -1.2), (0.4, 0.4))])
    assert isinstance(way, BlockedWay) and way.at_goal and way.by == (LAB + "Crate",)


def test_a_base_that_touches_something_where_it_starts_drives_off() -> None:
    state = world("ur5e_whiteboard").with_changes(
        thing("Charger", at(-0.4, 0.0, 0.4), size=(0.2, 0.2, 0.8), cls=FURNITURE)
    )
    start = pose(state, DOCK)
    assert isinstance(find_base_way(FloorPlan(state, ROBOT, start), start, pose(state, STORE)), BaseWay)
    assert any(each.individual == LAB + "Charger" for each in read_occupants(state))
    into = Pose(start.position + np.array([-0.1, 0.0, 0.0]), start.rotation)
    assert isinstance(find_base_way(FloorPlan(state, ROBOT, start), start, into), BlockedWay)


@pytest.mark.slow
def test_plan_run_and_why_tell_the_way_around(tmp_path: Path) -> None:
    scene = write_cell(tmp_path, ACROSS)
    space = ask("plan", scene, "--no-plan-cache")["space"]
    (way,) = space["ways"]
    assert (space["checked"], way["step"], way["place"], way["around"]) == (2, 1, "lab:Store", ["lab:Rack"])
    result = ask("run", scene, "--no-film", "--backend", "kinematic", "--out", str(tmp_path / "run"))
    assert (result["status"], result["failure"], result["touches"]) == ("succeeded", None, [])
    assert result["plan_in_space"]["ways"][0]["corners_m"] == way["corners_m"]
    told = CliRunner().invoke(skillc, ["why", str(tmp_path / "run")]).stdout
    assert "step 1: lab:Heron-1 drives to lab:Store by (" in told and "around lab:Rack" in told
    again = CliRunner().invoke(skillc, ["replay", str(tmp_path / "run"), "--check"])
    assert again.exit_code == 0 and "the same but for wall times" in again.output


@pytest.mark.slow
def test_a_blocked_way_is_refused_by_plan_run_and_check(tmp_path: Path, incurable: None) -> None:
    scene = write_cell(tmp_path, AROUND)
    answer = ask("plan", scene, "--no-plan-cache")
    assert answer["status"] == "gave-up"
    assert "the way of lab:Heron-1 to lab:BoardStation is blocked by lab:Wall-" in answer["failure"]
    ran = CliRunner().invoke(
        skillc, ["run", "--library", "wiping", "--scene", str(scene), "--goal", PICKED, "--no-film"]
    )
    assert ran.exit_code == 3 and "is blocked by lab:Wall-" in ran.output
    (tmp_path / "tasks.skill").write_text(TASK)
    found = json.loads(CliRunner().invoke(skillc, ["check", str(tmp_path), "--json", "--no-cache"]).stdout)
    assert [each["name"] for each in found] == ["infeasible-step"]
    assert "the way of lab:Heron-1 to lab:BoardStation is blocked by lab:Wall-" in found[0]["message"]


@pytest.mark.slow
def test_a_base_that_stands_in_the_way_drives_off_before_the_other_one_comes(tmp_path: Path) -> None:
    scene = tmp_path / "cell.ttl"
    scene.write_text(two_bases())
    answer = ask("plan", scene, "--no-plan-cache")
    driving = [each["arguments"]["robot"] for each in answer["plan"] if each["skill"] == "Drive"]
    assert driving == ["lab:Heron-2", "lab:Heron-1"] and answer["space"]["checked"] == 3
    assert {(each["one"], each["other"]) for each in answer["space"]["apart"]} >= {(1, 2)}
    result = ask("run", scene, "--no-film", "--backend", "kinematic", "--out", str(tmp_path / "run"))
    assert (result["status"], result["failure"], result["touches"]) == ("succeeded", None, [])


@pytest.mark.sim
def test_in_physics_the_base_arrives_around_what_stands_in_its_way(tmp_path: Path) -> None:
    result = ask("run", write_cell(tmp_path, ACROSS), "--no-film", "--out", str(tmp_path / "run"))
    assert (result["status"], result["failure"], result["touches"]) == ("succeeded", None, [])
    assert result["plan_in_space"]["ways"][0]["around"][0]["label"] == "lab:Rack"
