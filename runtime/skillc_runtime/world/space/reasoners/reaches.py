"""`reaches`: an arm reaches an object from its current pose."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.reach import reach_obstacle

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Reaches:
    """The object is no farther from the arm's shoulder than the reach in its data sheet."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return by how much the object is out of reach; None when the arm reaches it."""
        return reach_obstacle(state, subject, frame_tree_of(state).pose(subject), object_)
