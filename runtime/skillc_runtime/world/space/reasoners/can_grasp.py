"""`canGrasp`: a gripper takes a thing as it lies, between its fingers and by its weight."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.grasping.grasps import grasp_problem
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.python_calls import InsufficientFacts

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class CanGrasp:
    """The thing fits between the open fingers, they reach far enough around it, and friction bears its weight."""

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return why the gripper cannot grasp the object, with numbers; None when it can."""
        try:
            problem = grasp_problem(state, subject, object_)
        except SheetError as error:
            raise InsufficientFacts(str(error)) from error
        return None if problem is None else str(problem)
