"""Says of which places that a goal names are full, or blocked: what shall be there cannot be put down."""

from __future__ import annotations

from typing import TypeVar

from msgspec import structs

from skillc_model.conditions import Condition
from skillc_runtime.planning.plan import GaveUp
from skillc_runtime.world.state.world_state import WorldState

T = TypeVar("T")

MOST = 20
"""Of how many things is it looked at, at most, whether they can be put where the goal wants them."""


def name_goal_places(answer: T, goal: Condition, state: WorldState) -> T | GaveUp:
    """Return an answer to a goal; if no plan was found, it says first which things cannot be put where that wants them.

    That is so as everything stands now, of each thing on its own.
    """
    if not isinstance(answer, GaveUp):
        return answer
    # Whoever only plans needs no numpy.
    from skillc_runtime.world.space.placing.place_foresight import find_place_problem, list_wanted, uses_place_pose

    if not uses_place_pose(state):
        return answer
    wanted = list(list_wanted(state, goal))[:MOST]
    problems = (str(each) for each in (find_place_problem(state, *one) for one in wanted) if each is not None)
    more = [each for each in dict.fromkeys(problems) if each not in answer.why]
    return structs.replace(answer, why="; ".join((*more, answer.why)))
