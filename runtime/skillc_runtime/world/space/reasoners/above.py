"""`isAbove`: an object is over another, at any height."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.bounding_boxes import TOUCH_M
from skillc_runtime.world.space.hollow import gap_below
from skillc_runtime.world.space.whereabouts import unknown_place

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Above:
    """The object is vertically below the subject's middle, and no part of the subject is lower than its top."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return why the subject is not above the object; None when it is."""
        unknown = unknown_place(state, subject, object_)
        if unknown is not None:
            return unknown
        short = state.vocabulary.short
        if subject == object_:
            return "nothing is above itself"
        gap_m = gap_below(state, subject, object_)
        if gap_m is None:
            return f"{short(object_)} is not below the middle of {short(subject)}"
        if gap_m < -TOUCH_M:
            return f"{short(subject)} reaches {-gap_m:.3f} m below the top of {short(object_)}"
        return None
