"""How much room there is above a place, below boards of shelves and table tops: hands that point down need it."""

from __future__ import annotations

from contextlib import suppress
from typing import Final

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.bodies import read_body
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import SHAPE
from skillc_runtime.world.state.world_state import WorldState

HAND_ABOVE_M: Final = 0.25
"""The room that a hand that points down, and the wrist over it, need above the tool centre point."""

ROOFED: Final = ("shelf", "table")
"""The shapes below which there is room for things."""


def roof_problem(state: WorldState, point: Array, needed_m: float) -> str | None:
    """Return that there is less room than needed, in m, above a point (3,) in m in the world; else None."""
    found = roof_above(state, point)
    if found is None or found[0] >= needed_m:
        return None
    return (
        f"{state.vocabulary.short(found[1])} is {1e3 * found[0]:.0f} mm above, and a hand that comes from above needs "
        f"{1e3 * needed_m:.0f} mm"
    )


def roof_above(state: WorldState, point: Array) -> tuple[float, str] | None:
    """Return how far the nearest board is above a point (3,) in m in the world, in m, and of what it is a part."""
    found = []
    for individual in sorted({each for each, shape in state.stored.get(SHAPE, {}).items() if shape in ROOFED}):
        with suppress(FrameError, SheetError):
            body = read_body(state, individual)
            boxes = [] if body is None else [OrientedBox.of(body.pose @ s.place, np.array(s.half)) for s in body.solids]
            x, y, z = point.tolist()
            over = [box.lowest - z for box in boxes if box.height_at(x, y) is not None]
            found += [(gap, individual) for gap in over if gap > 0.0]
    return min(found, default=None)
