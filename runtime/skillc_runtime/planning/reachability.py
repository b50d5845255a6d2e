"""Decides whether a goal is unreachable from a world, without searching for a plan."""

from __future__ import annotations

from dataclasses import dataclass

from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.pddl.formulas import FALSE, conjuncts
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import Cancelled, cancelling, limit_current
from skillc_runtime.planning.abstraction.lower_bound import relax_scene
from skillc_runtime.planning.foresight import explain_unsupported, foresee
from skillc_runtime.planning.problem.chains import unroll_chains
from skillc_runtime.planning.problem.initial_state import TooManyValues
from skillc_runtime.planning.problem.neighbourhood import AT_ONCE
from skillc_runtime.planning.problem.pose import GoalError, already_holds
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.unsolvability import EXPLANATION_S, explain_unsolvable, pose_to_explain
from skillc_runtime.world.eval.obstacles import RelationObstacle
from skillc_runtime.world.state.world_state import WorldState

REACHABILITY_S = 10.0
"""The time limit for one goal."""


@dataclass(frozen=True, slots=True)
class UnreachableGoal:
    """Why no plan reaches a goal; not `proved` if a skill, or the goal itself, cannot be expressed for planners.

    `obstacles` is what the reasoners of computed relations say against it, if that is the reason.
    """

    why: str
    proved: bool = True
    obstacles: tuple[RelationObstacle, ...] = ()


def explain_unreachable(library: SkillLibrary, state: WorldState, goal: Condition) -> UnreachableGoal | None:
    """Return why no plan can reach the goal, even if actions deleted nothing; None if a plan may exist or if unknown.

    In a large scene only the part near the goal is considered in detail; the rest is abstracted (`relax_scene`). It is
    not known, either, if the time limit ends before.
    """
    try:
        with cancelling(limit_current(REACHABILITY_S)):
            return _explain(library, state, goal)
    except GoalError as error:
        return UnreachableGoal(str(error), proved=False)
    except (TooManyValues, Cancelled):
        return None


def _explain(library: SkillLibrary, state: WorldState, goal: Condition) -> UnreachableGoal | None:
    if already_holds(goal, state):
        return None
    unsupported = explain_unsupported(goal, state)
    if unsupported is not None:
        return UnreachableGoal(unsupported)
    library, state = foresee(library, state, goal)
    unrolled = unroll_chains(library, state, goal)
    posed, state, goal = unrolled.pose((), AT_ONCE), unrolled.state, unrolled.goal
    problem = relax_scene(posed, state) if posed.narrowed else posed.problem
    if problem is None or _is_reachable(problem):
        return None
    whole = replace(posed, problem=problem) if posed.narrowed else pose_to_explain(posed, state, goal, (), AT_ONCE)
    reason = explain_unsolvable(whole, goal, state)
    return UnreachableGoal("; ".join(reason.causes) or reason.why, not posed.restricted, reason.obstacles)


def _is_reachable(problem: Problem) -> bool:
    """Whether all parts of the goal are reachable; True also if the time limit ends before this is known."""
    grounding = Grounding(problem, limit_current(EXPLANATION_S))
    try:
        grounding.explore()
        wanted = grounding.goal()
    except Cancelled:
        return True
    return wanted != FALSE and all(grounding.is_possible(part) for part in conjuncts(wanted))
