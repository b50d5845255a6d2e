"""Makes what is to be carried out from what is requested of a cell."""

from __future__ import annotations

from collections.abc import Mapping

from skillc.errors import RequestError
from skillc.services.tasks.assignments import assign_call, assign_goal, assign_task
from skillc.services.tasks.listing import find_task
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.world.state.world_state import WorldState


def assign_request(
    task: str | None,
    goal: str | None,
    call: str | None,
    arguments: Mapping[str, str],
    library: SkillLibrary,
    state: WorldState,
) -> Assignment:
    """Return the assignment of a task with arguments, a goal, or a call of a skill, in a version of the world.

    RequestError if it is not exactly one of them, or there is no such task; DiagnosticsError if a text has errors.
    """
    match (task, goal, call):
        case (str(name), None, None):
            return assign_task(find_task(library, name), library, state, arguments)
        case (None, str(text), None):
            return assign_goal(text, library, state)
        case (None, None, str(text)):
            return assign_call(text, library, state)
        case _:
            raise RequestError("name exactly one of a task, a goal and a call")
