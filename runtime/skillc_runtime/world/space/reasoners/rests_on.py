"""`restsOn`: an object lies or stands on another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.bounding_boxes import TOUCH_M
from skillc_runtime.world.space.hollow import gap_below
from skillc_runtime.world.space.reasoners.above import Above
from skillc_runtime.world.space.whereabouts import unknown_place

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class RestsOn:
    """The subject is above the object and touches it."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return why the subject is not above the object, or the gap; None when it rests on it."""
        unknown = unknown_place(state, subject, object_)
        if unknown is not None:
            return unknown
        gap_m = None if subject == object_ else gap_below(state, subject, object_)
        if gap_m is None or gap_m < -TOUCH_M:
            return Above().obstacle(state, subject, object_)
        if gap_m <= TOUCH_M:
            return None
        return f"{state.vocabulary.short(subject)} is {gap_m:.3f} m above {state.vocabulary.short(object_)}"
