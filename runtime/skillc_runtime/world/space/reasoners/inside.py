"""`isInside`: an object is inside the bounding box of another."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.bounding_boxes import TOUCH_M, bounding_box, solid_box

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Inside:
    """All corners of the subject's bounding box lie inside the bounding box of the object."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return how far the subject sticks out; None when it is inside."""
        if subject == object_:
            return "nothing is inside itself"
        overhang_m = solid_box(state, object_).overhang(bounding_box(state, subject).corners)
        if overhang_m <= TOUCH_M:
            return None
        return f"{state.vocabulary.short(subject)} sticks out by {overhang_m:.3f} m"
