"""What geometry says of two things: at the boundaries, and the same wherever the whole scene is put."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_ontology import catalogue
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.bounding_boxes import TOUCH_M, bounding_box
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.changes import ClearProperty, RemoveIndividual, RemoveRelation, SetProperty
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import (
    AT,
    BASE_FRAME_ID,
    CONTAIN,
    CONTAINER,
    FURNITURE,
    HAS_SHEET,
    SIZE,
    WORKSTATION,
)
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import EMPTY, LAB, at, lab, linked, poses, skillc, thing, vectors, world

INSIDE, ABOVE, RESTS_ON, REACHES, CAN_REACH = map(skillc, ("isInside", "isAbove", "restsOn", "reaches", "canReach"))
CUBE = (0.2, 0.2, 0.2)


def holds(state: WorldState, relation: str, subject: str, object_: str) -> bool:
    return state.holds(lab(subject), relation, lab(object_))


def why(state: WorldState, relation: str, subject: str, object_: str) -> str:
    """Return what keeps a relation from holding."""
    obstacle = state.axioms.computed[relation].obstacle(state, lab(subject), lab(object_))
    assert obstacle is not None
    return obstacle


def on_a_table(x: float, y: float, z: float) -> WorldState:
    """Return a world with a cube beside, on or in a table whose top, 1 m by 0.6 m, is 0.7 m high."""
    return world(
        thing("Table", at(0, 0, 0.7), size=(1.0, 0.6, 0.7), cls=FURNITURE), thing("Cube", at(x, y, z), size=CUBE)
    )


@pytest.mark.parametrize(
    ("place", "true"),
    [
        ((0, 0, 0.8), {ABOVE, RESTS_ON}),
        ((0.49, -0.29, 0.8), {ABOVE, RESTS_ON}),
        ((0.51, 0, 0.8), set()),
        ((0, 0, 0.8 + 0.9 * TOUCH_M), {ABOVE, RESTS_ON}),
        ((0, 0, 0.8 + 1.1 * TOUCH_M), {ABOVE}),
        ((0, 0, 0.8 - 0.9 * TOUCH_M), {ABOVE, RESTS_ON}),
        ((0, 0, 0.8 - 1.1 * TOUCH_M), set()),
        ((0, 0, 3.0), {ABOVE}),
        ((0, 0, 0.35), {INSIDE}),
        ((0.4 + 0.9 * TOUCH_M, 0.2, 0.6), {INSIDE}),
        ((0.4 + 1.1 * TOUCH_M, 0.2, 0.6), set()),
        ((0, 0, -0.2), set()),
    ],
)
def test_a_cube_at_a_table(place: tuple[float, float, float], true: set[str]) -> None:
    state = on_a_table(*place)
    assert {each for each in (INSIDE, ABOVE, RESTS_ON) if holds(state, each, "Cube", "Table")} == true
    assert not any(holds(state, each, "Table", "Cube") for each in (INSIDE, RESTS_ON))


def test_what_keeps_it_from_holding_is_told_with_numbers() -> None:
    assert why(on_a_table(0.6, 0, 0.6), INSIDE, "Cube", "Table").endswith("Cube sticks out by 0.200 m")
    assert why(on_a_table(0.6, 0, 0.8), ABOVE, "Cube", "Table").endswith("Cube")
    assert "0.100 m below the top of" in why(on_a_table(0, 0, 0.7), ABOVE, "Cube", "Table")
    assert "Cube is 0.300 m above" in why(on_a_table(0, 0, 1.1), RESTS_ON, "Cube", "Table")
    assert why(on_a_table(0, 0, 0.8), ABOVE, "Cube", "Cube") == "nothing is above itself"


def test_where_too_little_is_known_nothing_holds_and_what_is_missing_is_told() -> None:
    state = on_a_table(0, 0, 0.35).with_changes([*thing("Lost"), *thing("Point", at(0, 0, 0.3))])
    assert holds(state, INSIDE, "Point", "Table") and not holds(state, INSIDE, "Lost", "Table")
    assert "does not say where" in why(state, INSIDE, "Lost", "Table")
    assert "Point has no" in why(state, INSIDE, "Table", "Point")
    half = state.with_changes([ClearProperty(lab("Cube"), SIZE[2])])
    assert "Cube has no" in why(half, INSIDE, "Cube", "Table")
    assert state.subjects(INSIDE, lab("Table")) == {lab("Cube"), lab("Point")}


def test_what_is_wrong_with_a_frame_is_no_answer() -> None:
    state = on_a_table(0, 0, 0.8).with_changes(placement_changes(lab("Cube"), at(0, 0, 0), "Cube"))
    with pytest.raises(EvaluationError, match=r"isInside\(Cube, Table\) failed: .* form a circle"):
        holds(state, INSIDE, "Cube", "Table")


boxes = st.tuples(*3 * [st.floats(0.05, 2.0)])


@settings(max_examples=40)
@given(poses, boxes, poses, boxes)
def test_inside_means_that_every_point_is(
    one: Pose, small: tuple[float, ...], other: Pose, large: tuple[float, ...]
) -> None:
    near = Pose(other.position + 0.1 * one.position, one.rotation)
    state = world(thing("A", near, size=small), thing("B", other, size=large))
    sides = np.linspace(-0.5, 0.5, 5)
    points = np.array([near.apply(np.array([x, y, z]) * small) for x in sides for y in sides for z in sides])
    local = np.abs((points - other.position) @ other.rotation) - np.array(large) / 2
    margin = abs(local.max() - TOUCH_M)
    assert margin < 1e-9 or holds(state, INSIDE, "A", "B") == bool(local.max() <= TOUCH_M)


@settings(max_examples=40)
@given(vectors(1.0), boxes, poses, boxes)
def test_above_means_that_what_is_straight_below_is_lower_than_all_of_it(
    offset: Array, small: tuple[float, ...], other: Pose, large: tuple[float, ...]
) -> None:
    over = Pose(other.position + offset + np.array([0, 0, 1.0]), np.eye(3))
    state = world(thing("A", over, size=small), thing("B", other, size=large))
    x, y, z = over.position
    below = bounding_box(state, lab("B"))
    top = below.height_at(x, y)
    if top is None:
        assert not holds(state, ABOVE, "A", "B")
        heights = z + np.linspace(-6, 6, 201)
        assert all(below.overhang(np.array([[x, y, height]])) > 0 for height in heights)
    else:
        assert abs(below.overhang(np.array([[x, y, top]]))) < 1e-9
        assert below.overhang(np.array([[x, y, top + 0.01]])) > 0
        gap = z - small[2] / 2 - top
        assert abs(gap + TOUCH_M) < 1e-9 or holds(state, ABOVE, "A", "B") == (gap >= -TOUCH_M)


def rigid(state: WorldState, by: Pose) -> WorldState:
    """Return the world in which everything that is placed in the map has been moved."""
    roots = [each for each in sorted(state.individuals) if state.value(each, BASE_FRAME_ID) == "map"]
    assert roots
    return state.with_changes([change for each in roots for change in placement_changes(each, by @ pose(state, each))])


SCENES = [
    load_scene(catalogue.scene_path(name), EMPTY.vocabulary) for name in ("ur5e_whiteboard.ttl", "iiwa_table.ttl")
]
ALL = (INSIDE, ABOVE, RESTS_ON, REACHES, CAN_REACH)
EXPECTED = [{relation: set(state.pairs(relation)) for relation in ALL} for state in SCENES]


@settings(max_examples=4)
@given(st.sampled_from((0, 1)), vectors(10.0), st.floats(-3, 3))
def test_a_scene_that_is_moved_and_turned_as_a_whole_is_the_same_scene(which: int, by: Array, angle: float) -> None:
    moved = rigid(SCENES[which], Pose(by, exp(np.array([0.0, 0.0, angle]))))
    assert {relation: set(moved.pairs(relation)) for relation in ALL} == EXPECTED[which]


@settings(max_examples=4)
@given(st.sampled_from((0, 1)), poses)
def test_being_inside_and_within_reach_do_not_depend_on_where_up_is(which: int, by: Pose) -> None:
    moved = rigid(SCENES[which], by)
    for relation in (INSIDE, REACHES, CAN_REACH):
        assert set(moved.pairs(relation)) == EXPECTED[which][relation]


def test_the_shipped_scenes_are_as_they_look() -> None:
    board, table = EXPECTED
    assert (LAB + "Eraser-1", LAB + "StoreTable") in board[RESTS_ON]
    assert (LAB + "Iiwa-1", LAB + "Pedestal") in table[RESTS_ON]
    assert board[CAN_REACH] == {(LAB + "Ur5e-1", LAB + "Whiteboard-1")}
    assert (LAB + "Ur5e-1", LAB + "Whiteboard-1") not in board[REACHES], "the robot is still at the dock"
    assert table[CAN_REACH] == {(LAB + "Iiwa-1", LAB + "Table-1")} < table[REACHES]


FURTHEST_M = float(np.sqrt((0.85 + 0.15) ** 2 - 0.2**2 - (1.05 + 0.15 - 0.6 - 0.1625) ** 2))
"""How far in front of its shoulder a UR5e, which reaches 0.85 m, gets with its hand of 0.15 m at the upper corners."""


def board_at(distance_m: float, station: str = "BoardStation") -> WorldState:
    """Return the whiteboard scene with the board so far in front of the arm once the robot stands at its station."""
    state = SCENES[0]
    board = Pose(np.array([3.2 + distance_m, 0.4, 1.05]), pose(state, lab("Whiteboard-1")).rotation)
    return state.with_changes(
        [*placement_changes(lab("Whiteboard-1"), board), linked(station, CONTAIN, "Whiteboard-1")]
    )


def test_an_arm_reaches_as_far_as_its_data_sheet_and_that_of_its_hand_say() -> None:
    for margin_m, true in ((-0.001, True), (0.001, False)):
        state = board_at(FURTHEST_M + margin_m)
        assert holds(state, CAN_REACH, "Ur5e-1", "Whiteboard-1") is true
        there = state.with_changes([linked("Heron-1", AT, "BoardStation")])
        assert holds(there, REACHES, "Ur5e-1", "Whiteboard-1") is true
        assert not holds(state, REACHES, "Ur5e-1", "Whiteboard-1")
    assert why(board_at(1.0), CAN_REACH, "Ur5e-1", "Whiteboard-1") == (
        "at lab:BoardStation: lab:Ur5e-1 reaches 1.00 m from its shoulder with its hand, and lab:Whiteboard-1 is up to "
        "1.11 m away"
    )


def test_a_robot_that_drives_works_from_the_station_of_the_surface_and_from_any_where_none_has_it() -> None:
    assert not holds(board_at(0.6, "Dock"), CAN_REACH, "Ur5e-1", "Whiteboard-1")
    free = board_at(0.6).with_changes([RemoveRelation(lab("BoardStation"), CONTAIN, lab("Whiteboard-1"))])
    assert holds(free, CAN_REACH, "Ur5e-1", "Whiteboard-1")
    nowhere = free.with_changes([RemoveIndividual(each) for each in free.instances(WORKSTATION) - {lab("Dock")}])
    assert why(nowhere, CAN_REACH, "Ur5e-1", "Whiteboard-1").startswith("at lab:Dock: ")
    there = nowhere.with_changes([*placement_changes(lab("Heron-1"), at(3, 0.4, 0)), RemoveIndividual(lab("Dock"))])
    assert why(there, CAN_REACH, "Ur5e-1", "Whiteboard-1") == (
        "there is no workstation at which lab:Heron-1 could stand"
    )
    assert holds(there, REACHES, "Ur5e-1", "Whiteboard-1")


def test_an_arm_without_a_data_sheet_reaches_nothing_and_says_so() -> None:
    bare = SCENES[1].with_changes([RemoveRelation(lab("Iiwa-1"), HAS_SHEET, skillc("iiwa14-sheet"))])
    assert not holds(bare, CAN_REACH, "Iiwa-1", "Table-1")
    assert "Iiwa-1 has no data sheet" in why(bare, CAN_REACH, "Iiwa-1", "Table-1")
    assert "takes (rparts:ArmDevice, skillc:Surface)" in why(bare, CAN_REACH, "Table-1", "Iiwa-1")


BIN = thing("Bin", at(0, 0, 0.05), size=(0.3, 0.2, 0.1), cls=CONTAINER)


@pytest.mark.parametrize(
    ("place", "true"),
    [
        ((0, 0, 0.004 + 0.06), {INSIDE, ABOVE, RESTS_ON}),
        ((0.1, -0.04, 0.004 + 0.06), {INSIDE, ABOVE, RESTS_ON}),
        ((0.125, 0, 0.004 + 0.06), {ABOVE, RESTS_ON}),
        ((0, 0, 0.09), {INSIDE, ABOVE}),
        ((0, 0, 0.11), {ABOVE}),
        ((0, 0, 0.05), set()),
        ((0.149, 0, 0.16), {ABOVE, RESTS_ON}),
        ((0.2, 0, 0.16), set()),
    ],
)
def test_a_tall_part_at_a_bin(place: tuple[float, float, float], true: set[str]) -> None:
    state = world(BIN, thing("Part", at(*place), size=(0.06, 0.06, 0.12)))
    assert {each for each in (INSIDE, ABOVE, RESTS_ON) if holds(state, each, "Part", "Bin")} == true


def test_why_a_part_is_not_in_a_bin() -> None:
    state = world(BIN, thing("Part", at(0, 0, 0.11), size=(0.06, 0.06, 0.12)))
    assert why(state, INSIDE, "Part", "Bin").endswith("Part is 0.010 m above the rim")
    beside = world(BIN, thing("Part", at(0.15, 0, 0.064), size=(0.06, 0.06, 0.12)))
    assert why(beside, INSIDE, "Part", "Bin").endswith("Part sticks out by 0.034 m")


@settings(max_examples=40)
@given(poses)
def test_a_ball_rests_on_a_table_however_it_is_turned(turned: Pose) -> None:
    state = world(
        thing("Table", at(0, 0, 0.7), size=(1.0, 0.6, 0.7), cls=FURNITURE),
        thing("Ball", Pose(np.array([0.0, 0.0, 0.75]), turned.rotation), size=(0.1, 0.1, 0.1)),
        [SetProperty(lab("Ball"), skillc("shape"), "sphere")],
    )
    assert holds(state, RESTS_ON, "Ball", "Table")


def test_a_part_rests_on_the_board_of_a_shelf_that_is_under_it() -> None:
    shelf = thing("Shelf", at(0, 0, 0.5), size=(0.6, 0.3, 1.0), cls=CONTAINER)
    shape = [SetProperty(lab("Shelf"), skillc("shape"), "shelf")]
    middle = world(shelf, shape, thing("Part", at(0, 0, 0.5 + 0.009 + 0.03), size=(0.06, 0.06, 0.06)))
    assert holds(middle, RESTS_ON, "Part", "Shelf") and holds(middle, INSIDE, "Part", "Shelf")
    between = world(shelf, shape, thing("Part", at(0, 0, 0.7), size=(0.06, 0.06, 0.06)))
    assert not holds(between, RESTS_ON, "Part", "Shelf")
