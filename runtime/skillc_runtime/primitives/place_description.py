"""Describes a position for messages: in the world frame and, if near one, relative to a surface."""

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
"""How far beside a surface, and above or below it, a position is described relative to it."""


def describe_place(state: WorldState, place: Array) -> str:
    """Return a position (3,) in m in the world as text, also relative to the nearest surface that is close."""
    on_map = f"{_coordinates(place)} in the frame {WORLD_FRAME!r}"
    near = min(_nearby_surfaces(state, place), key=lambda seen: abs(float(seen[1][2])), default=None)
    if near is None:
        return on_map
    surface, seen = near
    return f"{on_map}, which is {_coordinates(seen)} on {state.vocabulary.short(surface)}"


def _nearby_surfaces(state: WorldState, place: Array) -> Iterator[tuple[str, Array]]:
    """Yield the surfaces that a position is close to, each with the position (3,) in its frame."""
    for surface in sorted(state.instances(SURFACE)):
        try:
            seen, half = pose(state, surface).inverse().apply(place), size(state, surface)[:2] / 2
        except FrameError:
            continue
        if (np.abs(seen[:2]) <= half + NEAR_M).all() and abs(seen[2]) <= ABOVE_M:
            yield surface, seen


def _coordinates(place: Array) -> str:
    x, y, z = (round(float(value), 3) + 0.0 for value in place)
    return f"({x:.3f}, {y:.3f}, {z:.3f}) m"
