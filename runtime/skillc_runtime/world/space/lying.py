"""Whether an object lies in or on a place, as far as poses and sizes tell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.motion.arrays import np
from skillc_runtime.world.space.bounding_boxes import bounding_box, solid_box

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState

RISE_M = 0.02
"""How far an object that lies on a place may be above it or sink into it: errors of estimates, and of sizes."""


def lying_problem(state: WorldState, thing: str, place: str) -> str | None:
    """Return why an object does not lie in or on a place; None if it does.

    It does if its middle is straight above the bounding box of the place or in it, and its lowest point is between the
    bottom and the top of that box, up to 2 cm beyond. FrameError when a pose is not known, MissingFact when the size of
    the place is not.
    """
    short, over, box = state.vocabulary.short, bounding_box(state, thing), solid_box(state, place)
    point = box.middle.inverse().apply(over.middle.position)
    aside = float(np.linalg.norm(np.maximum(np.abs(point[:2]) - box.half[:2], 0.0)))
    if aside > 0.0:
        return f"its middle is {aside * 1e2:.1f} cm beside {short(place)}"
    top = box.height_at(float(over.middle.position[0]), float(over.middle.position[1]))
    if top is None:
        return f"its middle is not above {short(place)}"
    gap, depth = over.lowest - top, over.lowest - box.lowest
    if gap > RISE_M:
        return f"its lowest point is {gap * 1e2:.1f} cm above {short(place)}"
    return None if depth > -RISE_M else f"its lowest point is {-depth * 1e2:.1f} cm below {short(place)}"
