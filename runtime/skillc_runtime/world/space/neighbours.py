"""Pairs of things that are near each other."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from skillc_runtime.motion.arrays import np
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.world_state import WorldState


def find_near_pairs(state: WorldState, cls: str, within_m: float) -> Iterator[tuple[str, str]]:
    """Yield the ordered pairs of things of a class whose boxes along the axes of the world are near each other.

    That is so if they are at most `within_m` apart along each of these axes, in m. Things without a known pose or with
    an incomplete size are in no pair; those without any size are points.
    """
    names, corners = [], []
    for each in sorted(state.instances(cls)):
        with suppress(FrameError, SheetError):
            corners.append(bounding_box(state, each).corners)
            names.append(each)
    if not names:
        return
    lows = np.array([each.min(axis=0) for each in corners]) - within_m
    highs = np.array([each.max(axis=0) for each in corners]) + within_m
    for index, one in enumerate(names):
        low, high = corners[index].min(axis=0), corners[index].max(axis=0)
        meets = (lows <= high).all(axis=1) & (highs >= low).all(axis=1)
        yield from ((one, names[other]) for other in np.flatnonzero(meets).tolist() if other != index)
