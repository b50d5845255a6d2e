"""`reaches`: an arm can get at a thing from where it is now."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.reach import reach_obstacle

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Reaches:
    """The thing is no farther from the arm's shoulder than its data sheet says it reaches."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Say how much too far away the thing is; None when the arm reaches it."""
        return reach_obstacle(state, subject, frame_tree_of(state).pose(subject), object_)
