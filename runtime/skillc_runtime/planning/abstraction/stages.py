"""Plans with the near part of a large scene first, then with more of it.

What a narrowed problem cannot tell is not claimed: its shortest plan is proven only if no plan of the whole scene can
be shorter (see `bound`), and that it has no plan means that more of the scene is looked at, up to all of it. Nor is
anything claimed of skills that cannot be planned with.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias, assert_never

from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.abstraction.lower_bound import relax_scene
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.problem.initial_state import TooManyValues
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.pose import Posed
from skillc_runtime.world.state.world_state import WorldState

STAGE_SHARE = 0.5
"""Of the time that is left a narrowed problem gets this share, so that a wider one can still be tried."""

BOUND_S = 2.0
"""Finding out whether a plan for a part of the scene is the cheapest of all takes no longer than this."""

Pose: TypeAlias = Callable[[AbstractionSize | None], Posed]
Answer: TypeAlias = Callable[[Posed, float], PlanResult]
Search: TypeAlias = Callable[[Problem, float], PlanResult]
Explain: TypeAlias = Callable[[Posed], str]


@dataclass(frozen=True, slots=True)
class PlanningStages:
    """How problems are posed, answered with a checked plan, searched without checking, and why they have no plan.

    Times are in seconds.
    """

    pose: Pose
    answer: Answer
    search: Search
    explain: Explain


def plan_in_stages(
    means: PlanningStages, state: WorldState, end: float, breadth: AbstractionSize | None, *, prove: bool
) -> PlanResult:
    """Return the answer for the smallest part of the scene that has one, until the time `end` of the monotonic clock.

    The first part has a `breadth`; without one it is the whole scene. With `prove`, and in a scene that is small, the
    part is widened until a plan is proven to be the cheapest, or nothing is left out.
    """
    best: Solved | None = None
    while True:
        try:
            posed = means.pose(breadth)
        except TooManyValues as reason:
            return best or GaveUp(str(reason))
        if breadth is None or not posed.narrowed:
            return _of_all(best, posed, means, end)
        answer = means.answer(posed, STAGE_SHARE * _left(end))
        match answer:
            case Solved():
                labelled = _labelled(answer, posed, means, state, end)
                best = _of_these_skills(labelled, posed)
                if labelled.optimal == "proven" or not (prove or posed.things <= breadth.whole):
                    return best
            case Unsolvable():
                why = _out_of_reach(posed, means, state, end)
                if why is not None:
                    return _no_plan(why, posed)
            case GaveUp():
                if _left(end) <= 0.0:
                    return best or answer
            case _:
                assert_never(answer)
        breadth = breadth.wider()


def _of_all(best: Solved | None, posed: Posed, means: PlanningStages, end: float) -> PlanResult:
    """Return the answer for the whole scene, or the best of the answers for its parts if there is none in time."""
    answer = means.answer(posed, _left(end))
    match answer:
        case Solved():
            return _of_these_skills(replace(answer, left_out=posed.left_out), posed)
        case Unsolvable():
            return _no_plan(means.explain(posed), posed)
        case GaveUp():
            return best or answer
        case _:
            assert_never(answer)


def _of_these_skills(solved: Solved, posed: Posed) -> Solved:
    """Return a plan without a claim on the skills and steps that it may not have; nothing takes less than no steps."""
    if not posed.restricted or not solved.plan.steps:
        return solved
    if solved.optimal == "proven":
        return replace(solved, optimal="optimal for the filtered problem")
    return replace(solved, at_least_s=None)


def _no_plan(why: str, posed: Posed) -> Unsolvable | GaveUp:
    """Return that there is no plan, which is proved only where every skill could be planned with."""
    return GaveUp(why) if posed.restricted else Unsolvable(why)


def _labelled(solved: Solved, posed: Posed, means: PlanningStages, state: WorldState, end: float) -> Solved:
    """Return a plan of a narrowed problem with what is known about it in the whole scene."""
    found = replace(solved, left_out=posed.left_out, at_least_s=None)
    if solved.optimal != "proven":
        return replace(found, optimal="best found")
    bound = _bound(posed, means, state, end)
    least_s = bound.bound_s if isinstance(bound, Solved) else 0.0
    if least_s >= solved.plan.duration_s:
        return found
    return replace(found, optimal="optimal for the filtered problem", at_least_s=least_s or None)


def _out_of_reach(posed: Posed, means: PlanningStages, state: WorldState, end: float) -> str | None:
    """Return why the whole scene has no plan, None if it may have one."""
    relaxed = relax_scene(posed, state)
    if relaxed is None or not isinstance(means.search(relaxed, STAGE_SHARE * _left(end)), Unsolvable):
        return None
    return means.explain(replace(posed, problem=relaxed))


def _bound(posed: Posed, means: PlanningStages, state: WorldState, end: float) -> PlanResult | None:
    problem = relax_scene(posed, state)
    return None if problem is None else means.search(problem, min(BOUND_S, _left(end)))


def _left(end: float) -> float:
    return max(end - time.monotonic(), 0.0)
