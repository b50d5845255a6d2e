"""Where things are believed to be: poses composed through the tree of frames, and what follows from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.terms import AT, BASE_FRAME_ID, FRAME_ID, ORIENTATION, POSITION, SIZE

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState

WORLD_FRAME = "map"


class FrameError(ValueError):
    """A pose that the world model does not hold; the message says of what and which fact is missing."""


class MissingFact(FrameError):
    """A number that `individual` lacks: its `property`, an IRI."""

    def __init__(self, state: WorldState, individual: str, property_: str) -> None:
        short = state.vocabulary.short
        super().__init__(f"{short(individual)} has no {short(property_)} in the world model")
        self.individual, self.property = individual, property_


def pose(state: WorldState, individual: str) -> Pose:
    """Return where a thing is in the world; a thing without a pose of its own is where the location it is at is.

    FrameError when a fact is missing, a frame is unknown, or frames form a circle.
    """
    result, seen = Pose(np.zeros(3), np.eye(3)), [individual]
    while True:
        base = state.value(individual, BASE_FRAME_ID)
        if base is None:
            individual = _location(state, individual)
        else:
            result = _own_pose(state, individual) @ result
            if base == WORLD_FRAME:
                return result
            individual = _owner(state, str(base), individual)
        if individual in seen:
            raise FrameError(f"the frames of {' and '.join(map(state.vocabulary.short, seen))} form a circle")
        seen.append(individual)


def normal(state: WorldState, surface: str) -> Array:
    """Return the direction (3,) that points out of a surface, in the world."""
    return pose(state, surface).rotation[:, 2].copy()


def size(state: WorldState, individual: str) -> Array:
    """Return a thing's extent (3,) in m along the axes of its frame."""
    return np.array([_number(state, individual, name) for name in SIZE])


def width(state: WorldState, tool: str) -> float:
    """Return a tool's extent in m across the direction of work."""
    return _number(state, tool, SIZE[1])


def _own_pose(state: WorldState, individual: str) -> Pose:
    position = [_number(state, individual, name) for name in POSITION]
    quaternion = [_number(state, individual, name) for name in ORIENTATION]
    return Pose.of(np.array(position), np.array(quaternion))


def _number(state: WorldState, individual: str, name: str) -> float:
    value = state.value(individual, name)
    if not isinstance(value, int | float):
        raise MissingFact(state, individual, name)
    return float(value)


def _location(state: WorldState, individual: str) -> str:
    places = sorted(state.objects(individual, AT))
    if not places:
        short = state.vocabulary.short(individual)
        raise FrameError(
            f"the world model does not say where {short} is: it has neither a BaseFrameId nor a place it is at"
        )
    return places[0]


def _owner(state: WorldState, frame: str, asking: str) -> str:
    owners = state.having(FRAME_ID, frame)
    if len(owners) != 1:
        found = f"{len(owners)} things have" if owners else "nothing has"
        short = state.vocabulary.short(asking)
        raise FrameError(f"{short} is placed in the frame `{frame}`, but {found} this FrameId")
    return owners[0]
