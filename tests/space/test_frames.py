"""Poses through the tree of frames, against a reference that multiplies matrices, and what frames can do wrong."""

from __future__ import annotations

import gc
from weakref import ref

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation, rotation_from_quaternion
from skillc_runtime.world.space.frame_tree import FrameError, MissingFact, Unplaced, frame_tree_of
from skillc_runtime.world.space.frames import (
    attachment_changes,
    move_changes,
    placement_changes,
    pose,
    relative_pose,
    size,
)
from skillc_runtime.world.state.changes import ClearProperty, SetProperty
from skillc_runtime.world.state.terms import (
    AT,
    BASE_FRAME_ID,
    CONTAIN,
    FRAME_ID,
    HAS_A,
    HAS_ARM,
    ORIENTATION,
    POSITION,
    SIZE,
    SKIROS,
)
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import at, lab, linked, poses, same, skillc, thing, world

NAMES = ("a", "b", "c", "d", "e", "f")
TURNED = Pose.of((1.0, 2.0, 0.0), (0.7071067811865476, 0.0, 0.0, 0.7071067811865476))
"""A quarter turn to the left."""


@st.composite
def trees(draw: st.DrawFn) -> tuple[WorldState, dict[str, tuple[str, Pose]]]:
    """Draw a world whose things stand in each other's frames, and for each its frame and its pose there."""
    placings = {name: (draw(st.sampled_from(("map", *NAMES[:index]))), draw(poses)) for index, name in enumerate(NAMES)}
    return world(*(thing(name, own, frame) for name, (frame, own) in placings.items())), placings


def matrix(own: Pose) -> Array:
    """Return a pose as a homogeneous matrix (4, 4), through the quaternion that the world model holds."""
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = rotation_from_quaternion(quaternion_from_rotation(own.rotation)), own.position
    return result


def expected(name: str, placings: dict[str, tuple[str, Pose]]) -> Array:
    frame, own = placings[name]
    return matrix(own) if frame == "map" else expected(frame, placings) @ matrix(own)


@settings(max_examples=30)
@given(trees(), st.sampled_from(NAMES))
def test_poses_are_composed_from_the_root(drawn: tuple[WorldState, dict[str, tuple[str, Pose]]], name: str) -> None:
    state, placings = drawn
    assert np.allclose(matrix(pose(state, lab(name))), expected(name, placings), atol=1e-9)


@settings(max_examples=30)
@given(trees(), st.sampled_from(NAMES), st.sampled_from(NAMES), st.sampled_from(NAMES))
def test_what_is_seen_from_another_thing_composes_and_inverts(
    drawn: tuple[WorldState, object], one: str, two: str, three: str
) -> None:
    a, b, c = map(lab, (one, two, three))
    state = drawn[0]
    assert same(relative_pose(state, a, b) @ relative_pose(state, b, c), relative_pose(state, a, c))
    assert same(relative_pose(state, a, b).inverse(), relative_pose(state, b, a))
    assert same(relative_pose(state, a, a), at(0, 0, 0))


@settings(max_examples=30)
@given(trees(), st.sampled_from(NAMES[3:]), st.sampled_from(NAMES[:3]), poses)
def test_a_thing_put_somewhere_is_there_and_all_else_keeps_its_own_pose(
    drawn: tuple[WorldState, dict[str, tuple[str, Pose]]], name: str, viewer: str, goal: Pose
) -> None:
    state, placings = drawn
    after = state.with_changes(move_changes(state, lab(name), goal, lab(viewer)))
    assert same(relative_pose(after, lab(viewer), lab(name)), goal)
    assert after.value(lab(name), BASE_FRAME_ID) == placings[name][0]
    assert same(pose(after, lab(viewer)), pose(state, lab(viewer)))


@settings(max_examples=30)
@given(trees(), st.sampled_from(NAMES[3:]), st.sampled_from(NAMES[:3]), poses)
def test_what_is_carried_stays_where_it_is_and_then_moves_along(
    drawn: tuple[WorldState, object], name: str, carrier: str, goal: Pose
) -> None:
    state = drawn[0]
    carried = state.with_changes(attachment_changes(state, lab(name), lab(carrier)))
    assert same(pose(carried, lab(name)), pose(state, lab(name)))
    held = relative_pose(carried, lab(carrier), lab(name))
    driven = carried.with_changes(placement_changes(lab(carrier), goal))
    assert same(pose(driven, lab(name)), goal @ held)


def test_a_thing_without_a_pose_of_its_own_is_where_that_is_which_carries_it() -> None:
    base = world(thing("Station", TURNED), thing("Robot"), thing("Arm", at(0, 1, 0), "Robot"), thing("Box"))
    state = base.with_changes(
        [linked("Robot", AT, "Station"), linked("Robot", HAS_A, "Box"), linked("Robot", HAS_ARM, "Arm")]
    )
    assert same(pose(state, lab("Robot")), TURNED)
    assert same(pose(state, lab("Box")), TURNED)
    assert np.allclose(pose(state, lab("Arm")).position, (0, 2, 0))
    held = state.with_changes([linked("Station", CONTAIN, "Box"), *placement_changes(lab("Robot"), at(9, 9, 9))])
    assert same(pose(held, lab("Box")), TURNED), "what contains a thing says where it is before what it is a part of"


def test_what_an_arm_carries_is_nowhere_unless_something_says_so() -> None:
    state = world(thing("Arm", at(0, 0, 1), cls=skillc("Ur5e")), thing("Hand")).with_changes(
        [linked("Arm", HAS_A, "Hand")]
    )
    with pytest.raises(Unplaced, match=r"does not say where .*Hand is: .*Arm carries it"):
        pose(state, lab("Hand"))
    told = state.with_changes(placement_changes(lab("Hand"), at(0, 0, 0.5), "Arm"))
    assert np.allclose(pose(told, lab("Hand")).position, (0, 0, 1.5))


BROKEN = {
    "circle": (
        [*thing("a", at(0, 0, 0), "b"), *thing("b", at(0, 0, 0), "c"), *thing("c", at(0, 0, 0), "b")],
        "frames of .*b and .*c form a circle",
    ),
    "unknown": (thing("a", at(0, 0, 0), "nowhere"), "placed in the frame `nowhere`, but nothing has this FrameId"),
    "twice": (
        [*thing("a", at(0, 0, 0), "same"), *(SetProperty(lab(each), FRAME_ID, "same") for each in "bc")],
        "but 2 things have this FrameId",
    ),
    "nowhere": (thing("a"), "does not say where .*a is: it has neither a BaseFrameId nor a place"),
    "half": ([*thing("a", at(0, 0, 0)), ClearProperty(lab("a"), POSITION[1])], "a has no .*PositionY in the world"),
    "no turn": (
        [*thing("a", at(0, 0, 0)), SetProperty(lab("a"), ORIENTATION[0], 0.0)],
        "orientation of .*a is no rotation",
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_what_is_wrong_with_a_frame_is_said(case: str) -> None:
    changes, message = BROKEN[case]
    state = world(list(changes))
    for _ in range(2):
        with pytest.raises(FrameError, match=message):
            pose(state, lab("a"))


def test_a_missing_number_is_named() -> None:
    state = world(thing("a", at(0, 0, 0), size=(1.0, 2.0)))
    with pytest.raises(MissingFact) as caught:
        size(state, lab("a"))
    assert (caught.value.individual, caught.value.property) == (lab("a"), SIZE[2])


def test_what_moves_with_a_thing_cannot_carry_it_or_say_where_it_is() -> None:
    state = world(thing("a", at(0, 0, 0)), thing("b", at(0, 0, 1), "a"), thing("c", at(0, 0, 1), "b"))
    with pytest.raises(FrameError, match=r"c moves with .*a, so it cannot carry it"):
        attachment_changes(state, lab("a"), lab("c"))
    with pytest.raises(FrameError, match=r"c moves with .*a, so its place cannot say where that is"):
        move_changes(state, lab("a"), at(0, 0, 0), lab("c"))


def test_the_frame_of_a_thing_without_a_frame_id_has_its_iri_as_name() -> None:
    state = world(thing("c", at(0, 0, 1)), [ClearProperty(lab("c"), FRAME_ID)], thing("d", at(1, 0, 0)))
    attached = state.with_changes(attachment_changes(state, lab("d"), lab("c")))
    assert attached.value(lab("d"), BASE_FRAME_ID) == lab("c")
    moved = attached.with_changes(placement_changes(lab("c"), at(0, 5, 1)))
    assert pose(moved, lab("d")).position == pytest.approx((1, 5, 0))
    named = attached.with_changes([SetProperty(lab("c"), FRAME_ID, "see")])
    with pytest.raises(FrameError, match="nothing has this FrameId"):
        pose(named, lab("d"))


def test_versions_that_agree_about_space_share_its_tree_and_no_version_is_kept_for_it() -> None:
    state = world(thing("a", at(0, 0, 0)), thing("b", at(0, 0, 1), "a"))
    pose(state, lab("b"))
    told = state.with_changes([SetProperty(lab("a"), SKIROS + "Weight", 1.0)])
    assert frame_tree_of(told) is frame_tree_of(state)
    lifted = state.with_changes(placement_changes(lab("a"), at(0, 0, 5)))
    assert frame_tree_of(lifted) is not frame_tree_of(state)
    assert np.allclose(pose(lifted, lab("b")).position, (0, 0, 6))
    assert np.allclose(pose(state, lab("b")).position, (0, 0, 1))
    former = ref(state)
    del state, told
    gc.collect()
    assert former() is None


def test_poses_cannot_be_changed_by_who_reads_them() -> None:
    state = world(thing("a", at(0, 0, 0)))
    with pytest.raises(ValueError, match="read-only"):
        pose(state, lab("a")).position[0] = 1.0


def test_a_frame_that_gets_another_name_is_found_by_that_name_alone() -> None:
    state = world(thing("a", at(0, 0, 1)), thing("b", at(0, 0, 1), "a"))
    assert np.allclose(pose(state, lab("b")).position, (0, 0, 2))
    renamed = state.with_changes([SetProperty(lab("a"), FRAME_ID, "new")])
    with pytest.raises(FrameError, match="nothing has this FrameId"):
        pose(renamed, lab("b"))
    told = renamed.with_changes([SetProperty(lab("b"), BASE_FRAME_ID, "new")])
    assert np.allclose(pose(told, lab("b")).position, (0, 0, 2))
