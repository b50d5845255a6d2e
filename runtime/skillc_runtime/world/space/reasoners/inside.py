"""`isInside`: an object lies in a bin, or inside the bounding box of another object."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.bounding_boxes import TOUCH_M, bounding_box, solid_box
from skillc_runtime.world.space.hollow import bin_shape, why_not_in_bin
from skillc_runtime.world.space.whereabouts import unknown_place

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Inside:
    """All corners of the subject's bounding box lie inside the bounding box of the object.

    In a bin lies what is between its walls, with its middle below the rim.
    """

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return how far the subject sticks out; None when it is inside."""
        unknown = unknown_place(state, subject, object_)
        if unknown is not None:
            return unknown
        if subject == object_:
            return "nothing is inside itself"
        bin_ = bin_shape(state, object_)
        if bin_ is not None:
            return why_not_in_bin(state, subject, object_, bin_)
        overhang_m = solid_box(state, object_).overhang(bounding_box(state, subject).corners)
        if overhang_m <= TOUCH_M:
            return None
        return f"{state.vocabulary.short(subject)} sticks out by {overhang_m:.3f} m"
