"""Poses of objects in the world and relative to each other, changes of poses, and sizes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose, quaternion_from_rotation
from skillc_runtime.world.space.frame_tree import WORLD_FRAME, FrameError, Unplaced, frame_tree_of
from skillc_runtime.world.state.changes import Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.terms import (
    ANCHOR,
    ANGLES,
    ARM_DEVICE,
    BASE_FRAME_ID,
    BOARD,
    FACE,
    FRAME_ID,
    HAS_SENSOR,
    MANIPULATABLE,
    MOBILE_ROBOT,
    OFFSET,
    ON,
    OPENING,
    ORIENTATION,
    POSITION,
    SIZE,
    TRAVEL,
)

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def pose(state: WorldState, individual: str) -> Pose:
    """Return the pose of an object in the world; an object without a pose of its own has that of its carrier.

    FrameError when a fact is missing, a frame is unknown, or frames form a cycle. The arrays are read-only.
    """
    return frame_tree_of(state).pose(individual)


def find_pose(state: WorldState, individual: str) -> Pose | None:
    """Return the pose of an object in the world, None if it is not known."""
    try:
        return pose(state, individual)
    except FrameError:
        return None


def relative_pose(state: WorldState, viewer: str, individual: str) -> Pose:
    """Return the pose of an object in the frame of another, the viewer; FrameError as for `pose`."""
    return pose(state, viewer).inverse() @ pose(state, individual)


def states_own_pose(state: WorldState, individual: str) -> bool:
    """Whether the pose of an object is stated: in a frame, or by what it is on; else it has that of its carrier."""
    return state.value(individual, BASE_FRAME_ID) is not None or (
        ON in state.facts and bool(state.facts[ON].forward.get(individual))
    )


def frame_name(state: WorldState, individual: str) -> str:
    """Return the name of the frame of an object: its FrameId, or its IRI if it has none."""
    frame = state.value(individual, FRAME_ID)
    return frame if isinstance(frame, str) else individual


def placement_changes(thing: str, at: Pose, frame: str = WORLD_FRAME) -> list[SetProperty]:
    """Return the changes that place an object, by IRI, at a pose in the frame with a name."""
    values = zip((*POSITION, *ORIENTATION), (*at.position, *quaternion_from_rotation(at.rotation)), strict=True)
    numbers = [SetProperty(thing, name, float(value)) for name, value in values]
    return [SetProperty(thing, BASE_FRAME_ID, frame), *numbers]


def relocation_changes(state: WorldState, thing: str, at: Pose, frame: str = WORLD_FRAME) -> list[Change]:
    """Return the changes that place an object at another pose in the frame with a name.

    Facts that stated its former pose in another way, by angles or by what it is on, are retracted. A drawer stays in
    its furniture: it is as far open as comes nearest to that pose.
    """
    travel = state.value(thing, TRAVEL) if TRAVEL in state.stored else None
    if isinstance(travel, float):
        return [SetProperty(thing, OPENING, _opening_at(state, thing, travel, at, frame))]
    stated = (name for name in (*ANGLES, *OFFSET, ANCHOR, FACE, BOARD) if name in state.stored)
    cleared = [ClearProperty(thing, name) for name in stated if state.value(thing, name) is not None]
    supports = state.facts[ON].forward.get(thing) if ON in state.facts else ()
    left = [RemoveRelation(thing, ON, each) for each in sorted(supports)]
    return [*cleared, *left, *placement_changes(thing, at, frame)]


def _opening_at(state: WorldState, drawer: str, travel_m: float, at: Pose, frame: str) -> float:
    """Return how far a drawer is open in m, from 0 to its travel, at a pose in the frame with a name."""
    there = frame_tree_of(state).frame_pose(frame, drawer) @ at
    present = state.value(drawer, OPENING)
    further = -float(pose(state, drawer).inverse().apply(there.position)[1])
    return min(max((present if isinstance(present, float) else 0.0) + further, 0.0), travel_m)


def move_changes(state: WorldState, thing: str, at: Pose, viewer: str) -> list[Change]:
    """Return the changes that move an object to the pose `at` in the frame of the viewer; its carrier stays the same.

    An object without a known pose is placed in the world frame. FrameError when the viewer's pose is not known or the
    viewer moves with the object.
    """
    if moves_with(state, viewer, thing):
        short = state.vocabulary.short
        raise FrameError(f"{short(viewer)} moves with {short(thing)}, so its place cannot say where that is")
    return place_changes(state, thing, pose(state, viewer) @ at)


def place_changes(state: WorldState, thing: str, goal: Pose) -> list[Change]:
    """Return the changes that move an object to the pose `goal` in the world; its carrier stays the same.

    An object without a known pose is placed in the world frame. FrameError when its frames are contradictory.
    """
    try:
        carrier = frame_tree_of(state).carrier(thing)
    except Unplaced:
        carrier = None
    if carrier is None:
        return relocation_changes(state, thing, goal)
    return relocation_changes(state, thing, pose(state, carrier).inverse() @ goal, frame_name(state, carrier))


def attachment_changes(state: WorldState, thing: str, carrier: str) -> list[Change]:
    """Return the changes that attach an object to a carrier; its pose in the world stays the same.

    FrameError when a pose is not known, or the carrier moves with the object.
    """
    if moves_with(state, carrier, thing):
        short = state.vocabulary.short
        raise FrameError(f"{short(carrier)} moves with {short(thing)}, so it cannot carry it")
    return relocation_changes(state, thing, relative_pose(state, carrier, thing), frame_name(state, carrier))


def put_down_changes(state: WorldState, thing: str, at: Pose, place: str) -> list[Change]:
    """Return the changes that place an object at a pose in the world, on or in a place that now contains it.

    It moves with a place that can move: a thing to handle, such as a tray, a drawer, or what a mobile robot carries.
    """
    if not _can_move(state, place):
        return relocation_changes(state, thing, at)
    in_place = pose(state, place).inverse() @ at
    return relocation_changes(state, thing, in_place, frame_name(state, place))


def _can_move(state: WorldState, place: str) -> bool:
    try:
        robots = [each for each in state.instances(MOBILE_ROBOT) if moves_with(state, place, each)]
    except FrameError:
        return False
    slides = TRAVEL in state.stored and state.value(place, TRAVEL) is not None
    return bool(robots) or slides or state.is_a(place, MANIPULATABLE)


def normal(state: WorldState, surface: str) -> Array:
    """Return the direction (3,), unitless and of length 1, that points out of a surface, in the world."""
    return pose(state, surface).rotation[:, 2].copy()


def size(state: WorldState, individual: str) -> Array:
    """Return the extent (3,) in m of an object along the axes of its frame; MissingFact when it is not known."""
    return np.array([frame_tree_of(state).number(individual, name) for name in SIZE])


def width(state: WorldState, tool: str) -> float:
    """Return a tool's extent in m across the direction of work; MissingFact when it is not known."""
    return frame_tree_of(state).number(tool, SIZE[1])


def moves_with(state: WorldState, individual: str, carrier: str) -> bool:
    """Whether an object is the carrier or moves with it; FrameError when its frames form a cycle or one is unknown."""
    space, at = frame_tree_of(state), individual
    space.pose(individual)
    while at != carrier:
        carried_by = space.carrier(at)
        if carried_by is None:
            return False
        at = carried_by
    return True


def arm_with_sensor(state: WorldState, sensor: str) -> str | None:
    """Return the arm that has a sensor, such as a camera on its flange, by IRI; None if no arm has it."""
    if HAS_SENSOR not in state.facts:
        return None
    return min((each for each in state.subjects(HAS_SENSOR, sensor) if state.is_a(each, ARM_DEVICE)), default=None)
