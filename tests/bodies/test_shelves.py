"""Things stand on the boards of shelves and on the floors of bins; hands that do not fit below a board are refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from bodies.test_trays import FOLDER, PART, library
from skillc_runtime.scene.load import load_scene, read_scene
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.space.grasping.grasps import find_grasp
from skillc_runtime.world.space.grasping.grip_force import GraspError
from skillc_runtime.world.space.placing.free_places import free_hand_pose
from skillc_runtime.world.space.placing.no_place import PlaceError
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.terms import (
    BOARD,
    BOARDS,
    CONTAINER,
    FACE,
    FURNITURE,
    OFFSET,
    ON,
    SHAPE,
)
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import PART as PART_CLASS
from space.rooms import at, lab, linked, thing, world

SHELF = [
    *thing("Shelf", at(0, 0, 0.83), size=(0.5, 0.3, 0.83), cls=FURNITURE),
    SetProperty(lab("Shelf"), SHAPE, "shelf"),
    SetProperty(lab("Shelf"), BOARDS, 4),
]
"""Boards of 18 mm, with their tops at 0.018, 0.288667, 0.559333 and 0.83 m."""


def on(support: str, *facts: SetProperty) -> list[Change]:
    """Return what says that a part of 4 cm is on something."""
    return [*thing("Part", size=(0.04, 0.04, 0.04), cls=PART_CLASS), linked("Part", ON, support), *facts]


@pytest.mark.parametrize(("board", "top"), [(1, 0.018), (2, 0.288667), (3, 0.559333), (4, 0.83)])
def test_a_thing_stands_on_the_board_of_its_number(board: int, top: float) -> None:
    state = world(SHELF, on("Shelf", SetProperty(lab("Part"), BOARD, board)))
    assert pose(state, lab("Part")).position == pytest.approx([0, -0.009, top + 0.02], abs=1e-6)


def test_a_thing_on_a_bin_stands_on_its_floor_and_on_its_rim_only_if_that_is_said() -> None:
    bin_ = thing("Bin", at(0, 0, 0.05), size=(0.2, 0.2, 0.1), cls=CONTAINER)
    assert pose(world(bin_, on("Bin")), lab("Part")).position == pytest.approx([0, 0, 0.024])
    rim = world(bin_, on("Bin", SetProperty(lab("Part"), FACE, "top")))
    assert pose(rim, lab("Part")).position == pytest.approx([0, 0, 0.12])
    corner = world(bin_, on("Bin", SetProperty(lab("Part"), FACE.replace("face", "anchor"), "corner")))
    assert pose(corner, lab("Part")).position == pytest.approx([-0.096, -0.096, 0.024])


def test_what_is_moved_off_a_board_is_on_no_board() -> None:
    state = world(SHELF, on("Shelf", SetProperty(lab("Part"), BOARD, 2)))
    assert state.with_changes(relocation_changes(state, lab("Part"), at(1, 1, 1))).value(lab("Part"), BOARD) is None


HEAD = """@prefix lab: <http://example.org/lab#> . @prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> . lab:Cell a skiros:Scene .
lab:Shelf a skillc:Furniture ; skiros:SizeX 0.5 ; skiros:SizeY 0.3 ; skiros:SizeZ 0.8 ; skillc:on lab:Cell {shape}.
lab:Part a skiros:Part ; skillc:on lab:Shelf ; skillc:board {board} .
"""


@pytest.mark.parametrize(
    ("shape", "board", "message"),
    [
        ('; skillc:shape "shelf" ', 3, None),
        ('; skillc:shape "shelf" ', 4, "lab:Part is on board 4 of lab:Shelf, which has 3"),
        ("", 1, "lab:Part is on board 1 of lab:Shelf, which is no shelf"),
    ],
)
def test_a_board_that_a_shelf_does_not_have_is_reported(
    shape: str, board: int, message: str | None, tmp_path: Path
) -> None:
    path = tmp_path / "cell.ttl"
    path.write_text(HEAD.format(shape=shape, board=board), "utf-8")
    found = [each.message for each in read_scene(path, library().vocabulary).problems]
    assert found == ([] if message is None else [message])


def cell(*changes: Change) -> WorldState:
    """Return the cell of the trays with a shelf of three boards, 0.2 m or 0.8 m high, on its table."""
    return load_scene(FOLDER / "cell.ttl", library().vocabulary).with_changes(changes)


def shelf_on_table(height_m: float, boards: int = 3) -> list[Change]:
    size = (0.4, 0.3, height_m)
    shelf = thing("Rack", at(0.55, 0.2, 0.6 + height_m), size=size, cls=FURNITURE)
    return [*shelf, SetProperty(lab("Rack"), SHAPE, "shelf"), SetProperty(lab("Rack"), BOARDS, boards)]


def on_rack(board: int) -> list[Change]:
    moved = [RemoveRelation(PART, ON, lab("Table")), AddRelation(PART, ON, lab("Rack"))]
    return [*moved, SetProperty(PART, BOARD, board), *(SetProperty(PART, name, 0.0) for name in OFFSET)]


@pytest.mark.parametrize(("height_m", "board", "fits"), [(0.25, 1, False), (0.25, 2, True), (0.7, 1, True)])
def test_what_lies_below_a_board_is_grasped_only_if_the_hand_fits(height_m: float, board: int, fits: bool) -> None:
    state = cell(*shelf_on_table(height_m, 2), *on_rack(board))
    if fits:
        assert find_grasp(state, lab("Hand-1"), PART, "above")
        return
    with pytest.raises(GraspError, match=r"lab:Rack is .* mm above, and a hand that comes from above needs 250 mm"):
        find_grasp(state, lab("Hand-1"), PART, "above")


def held(*changes: Change) -> WorldState:
    """Return a cell in which the hand holds the part."""
    state = cell(*changes)
    return state.with_changes(relocation_changes(state, PART, at(0, 0, 0), "hand"))


def place_height(state: WorldState) -> float:
    hand = free_hand_pose(state, lab("Panda-1"), lab("Hand-1"), PART, lab("Rack"))
    return float(hand.position[2])


def test_a_free_place_on_a_shelf_is_on_its_top_then_on_a_board_with_room_above_it() -> None:
    cover = thing("Cover", size=(0.4, 0.3, 0.05), cls=FURNITURE)
    covered = [*cover, linked("Cover", ON, "Rack")]
    assert place_height(held(*shelf_on_table(0.45, 2))) == pytest.approx(1.05 + 0.015)
    assert place_height(held(*shelf_on_table(0.45, 2), *covered)) == pytest.approx(0.618 + 0.015)
    with pytest.raises(
        PlaceError, match=r"on lab:Rack is clear of lab:Cover; on board 1 of .*, lab:Rack is .* mm above"
    ):
        place_height(held(*shelf_on_table(0.25, 2), *covered))


@pytest.mark.parametrize(
    ("x_m", "message"),
    [
        (0.12, "less than 0.25 m from the base of lab:Panda-1, or more than 0.85 m, its reach"),
        (0.75, None),
        (0.83, None),  # farther than things are put down where there is a choice
        (1.5, "no free place on lab:Rack is within the 0.85 m that lab:Panda-1 reaches: the nearest is 1.48 m from"),
    ],
)
def test_what_is_too_near_or_too_far_is_said_with_the_distances(x_m: float, message: str | None) -> None:
    state = held(*thing("Rack", at(x_m, 0, 0.6), size=(0.12, 0.12, 0.6), cls=FURNITURE))
    if message is None:
        assert place_height(state) == pytest.approx(0.615)
        return
    with pytest.raises(PlaceError, match=message) as raised:
        place_height(state)
    assert raised.value.lack == "reach"


@pytest.mark.parametrize(("half_m", "fits"), [(0.06, True), (0.04, True), (0.035, False)])
def test_between_things_fingers_open_only_as_far_as_there_is_room(half_m: float, fits: bool) -> None:
    """With the room that fingers get elsewhere, 0.04 m are too little."""
    posts = list[Change]()
    for number, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1))):
        place = at(0.55 + x * (half_m + 0.01), y * (half_m + 0.01), 0.7)
        sides = (0.02 if x else 2 * half_m, 0.02 if y else 2 * half_m, 0.1)
        posts += thing(f"Post-{number}", place, size=sides, cls=FURNITURE)
    state = held(*thing("Rack", at(0.55, 0, 0.6), size=(2 * half_m, 2 * half_m, 0.6), cls=FURNITURE), *posts)
    if fits:
        assert place_height(state) == pytest.approx(0.615)
        return
    with pytest.raises(PlaceError, match="is clear of lab:Post-0 and lab:Post-1") as raised:
        place_height(state)
    assert raised.value.lack == "clearance"
