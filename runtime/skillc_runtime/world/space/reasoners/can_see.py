"""`canSee`: a camera sees an object where that is believed to be, if nothing hides it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.field_of_view import field_of_view
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.state.data_sheet import SheetError

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class CanSee:
    """The middle of the object's bounding box is in the camera's field of view."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return why the middle of the object is out of view; None if it is in view."""
        try:
            view = field_of_view(state, subject)
        except SheetError as error:
            return str(error)
        middle = bounding_box(state, object_).middle.position
        return view.obstacle(frame_tree_of(state).pose(subject).inverse().apply(middle))
