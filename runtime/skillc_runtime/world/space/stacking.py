"""What is over what, and how far apart the two are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.boxes import box, solid

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState


def gap_below(state: WorldState, upper: str, lower: str) -> float | None:
    """Return how high in m the lowest point of a thing is over the top of another, straight below its middle.

    None when the other is not below its middle at all. FrameError when one is nowhere, MissingFact without a size.
    """
    over = box(state, upper)
    top = solid(state, lower).height_at(float(over.middle.position[0]), float(over.middle.position[1]))
    return None if top is None else over.lowest - top
