"""What counts as standing around, and what as a part of the arm."""

from __future__ import annotations

import numpy as np

from collision.around import box, world
from simulation.cells import ARM, ERASER, GRIPPER, LAB, PLACE
from skillc_runtime.collision.arm_assembly import ArmAssembly, read_arm_assembly
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.terms import CONTAIN, SIZE, WORKSPACE

SCENE = "iiwa_table"
IN_HAND = Pose.of((0.0, 0.0, 0.03), (0.0, 1.0, 0.0, 0.0))


def names(changes: list[Change]) -> list[str]:
    state = world(SCENE, changes)
    return [block.name for block in read_scenery(state, pose(state, ARM[SCENE])).blocks]


def taken() -> list[Change]:
    """The changes that put the eraser into the hand."""
    gripper = GRIPPER[SCENE]
    return [
        RemoveRelation(PLACE[SCENE], CONTAIN, ERASER),
        AddRelation(gripper, CONTAIN, ERASER),
        *placement_changes(ERASER, IN_HAND, "robotiq"),
    ]


def dressed(changes: list[Change]) -> ArmAssembly:
    return read_arm_assembly(world(SCENE, changes), ARM[SCENE], {GRIPPER[SCENE]: 0.05})


def test_whatever_has_a_place_and_a_size_stands_around() -> None:
    assert names([]) == ["lab:Eraser-1", "lab:Pedestal", "lab:SideTable", "lab:Table-1"]
    assert "lab:Box-1" in names(box("Box-1", (0.5, 0.5, 0.5), (0.1, 0.1, 0.1)))
    assert "lab:Box-1" not in names(box("Box-1", (9.0, 0.5, 0.5), (0.1, 0.1, 0.1)))


def test_a_workspace_is_nothing_to_touch() -> None:
    room = LAB + "Room"
    sizes = [SetProperty(room, name, 1.0) for name in SIZE]
    assert "lab:Room" not in names(
        [AddIndividual(room, (WORKSPACE,)), *sizes, *placement_changes(room, Pose.of((0.5, 0.0, 1.0)))]
    )


def test_boxes_are_seen_from_the_arm_by_their_middle() -> None:
    state = world(SCENE, [])
    table = next(b for b in read_scenery(state, pose(state, ARM[SCENE])).blocks if b.name == "lab:Table-1")
    assert np.allclose(table.place.position, (0.56, 0.05, 0.75 - 0.025 - 0.6))
    assert np.allclose(table.half, (0.15, 0.2, 0.025))


def test_what_is_held_moves_along_and_stands_around_no_more() -> None:
    hand = dressed(taken()).hand
    assert hand is not None
    assert [block.name for block in hand.held] == ["lab:Eraser-1"]
    assert np.allclose(hand.held[0].place.position, (0.0, 0.0, 0.03))
    assert names(taken()) == ["lab:Pedestal", "lab:SideTable", "lab:Table-1"]
    empty = dressed([]).hand
    assert empty is not None
    assert empty.held == ()


def test_the_same_facts_make_the_same_outfit_and_scenery() -> None:
    state, again = world(SCENE, []), world(SCENE, [])
    assert dressed([]) == dressed([]) and hash(dressed([])) == hash(dressed([])) and dressed([]) != dressed(taken())
    assert read_scenery(state, pose(state, ARM[SCENE])) == read_scenery(again, pose(again, ARM[SCENE]))
