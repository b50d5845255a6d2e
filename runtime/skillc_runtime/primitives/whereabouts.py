"""A place in the words of a person who knows the cell: on the map and, near one, on a surface."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frame_tree import WORLD_FRAME, FrameError
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.state.terms import SURFACE

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState

NEAR_M, ABOVE_M = 0.1, 0.2
"""How far beside a surface, and above or below it, a place is still told by that surface."""


def whereabouts(state: WorldState, place: Array) -> str:
    """Return where a place (3,) m of the world is, also as seen from the nearest surface that it is close to."""
    on_map = f"{_coordinates(place)} in the frame {WORLD_FRAME!r}"
    near = min(_near(state, place), key=lambda seen: abs(float(seen[1][2])), default=None)
    if near is None:
        return on_map
    surface, seen = near
    return f"{on_map}, which is {_coordinates(seen)} on {state.vocabulary.short(surface)}"


def _near(state: WorldState, place: Array) -> Iterator[tuple[str, Array]]:
    """Yield the surfaces that a place is close to, each with the place in its frame."""
    for surface in sorted(state.instances(SURFACE)):
        try:
            seen, half = pose(state, surface).inverse().at(place), size(state, surface)[:2] / 2
        except FrameError:
            continue
        if (np.abs(seen[:2]) <= half + NEAR_M).all() and abs(seen[2]) <= ABOVE_M:
            yield surface, seen


def _coordinates(place: Array) -> str:
    x, y, z = (round(float(value), 3) + 0.0 for value in place)
    return f"({x:.3f}, {y:.3f}, {z:.3f}) m"
