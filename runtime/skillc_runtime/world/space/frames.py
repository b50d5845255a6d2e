"""Where things are believed to be, in the world and seen from one another, and how large they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose, quaternion_of
from skillc_runtime.world.space.frame_tree import WORLD_FRAME, FrameError, Unplaced, frame_tree_of
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import BASE_FRAME_ID, FRAME_ID, ORIENTATION, POSITION, SIZE

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def pose(state: WorldState, individual: str) -> Pose:
    """Return where a thing is in the world; a thing without a pose of its own is where that is which carries it.

    FrameError when a fact is missing, a frame is unknown, or frames form a circle. The arrays are read-only.
    """
    return frame_tree_of(state).pose(individual)


def relative_pose(state: WorldState, viewer: str, individual: str) -> Pose:
    """Return where a thing is in the frame of another; FrameError as for `pose`."""
    return pose(state, viewer).inverse() @ pose(state, individual)


def placement_changes(thing: str, at: Pose, frame: str = WORLD_FRAME) -> list[SetProperty]:
    """Return the changes that say that a thing, by IRI, is at a pose in a frame, by its FrameId."""
    values = zip((*POSITION, *ORIENTATION), (*at.position, *quaternion_of(at.rotation)), strict=True)
    numbers = [SetProperty(thing, name, float(value)) for name, value in values]
    return [SetProperty(thing, BASE_FRAME_ID, frame), *numbers]


def move_changes(state: WorldState, thing: str, at: Pose, viewer: str) -> list[SetProperty]:
    """Return the changes that put a thing at a pose seen from another thing; what carries it goes on carrying it.

    What was nowhere is placed in the world. FrameError when the viewer is nowhere or moves with the thing.
    """
    if _moves_with(state, viewer, thing):
        short = state.vocabulary.short
        raise FrameError(f"{short(viewer)} moves with {short(thing)}, so its place cannot say where that is")
    goal = pose(state, viewer) @ at
    try:
        carrier = frame_tree_of(state).carrier(thing)
    except Unplaced:
        carrier = None
    if carrier is None:
        return placement_changes(thing, goal)
    return placement_changes(thing, pose(state, carrier).inverse() @ goal, _frame(state, carrier))


def attachment_changes(state: WorldState, thing: str, carrier: str) -> list[SetProperty]:
    """Return the changes that leave a thing where it is and let it move with another from now on.

    FrameError when either is nowhere, the carrier has no frame, or the carrier already moves with the thing.
    """
    if _moves_with(state, carrier, thing):
        short = state.vocabulary.short
        raise FrameError(f"{short(carrier)} moves with {short(thing)}, so it cannot carry it")
    return placement_changes(thing, relative_pose(state, carrier, thing), _frame(state, carrier))


def normal(state: WorldState, surface: str) -> Array:
    """Return the direction (3,) that points out of a surface, in the world."""
    return pose(state, surface).rotation[:, 2].copy()


def size(state: WorldState, individual: str) -> Array:
    """Return a thing's extent (3,) in m along the axes of its frame; MissingFact when it is not known."""
    return np.array([frame_tree_of(state).number(individual, name) for name in SIZE])


def width(state: WorldState, tool: str) -> float:
    """Return a tool's extent in m across the direction of work; MissingFact when it is not known."""
    return frame_tree_of(state).number(tool, SIZE[1])


def _moves_with(state: WorldState, individual: str, carrier: str) -> bool:
    """Whether one is the other or moves with it; FrameError when the frames of one form a circle or lead nowhere."""
    space, at = frame_tree_of(state), individual
    space.pose(individual)
    while at != carrier:
        below = space.carrier(at)
        if below is None:
            return False
        at = below
    return True


def _frame(state: WorldState, individual: str) -> str:
    frame = state.value(individual, FRAME_ID)
    if not isinstance(frame, str):
        raise FrameError(f"{state.vocabulary.short(individual)} has no FrameId, so nothing can be placed in its frame")
    return frame
