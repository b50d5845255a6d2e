"""Plans with the part of a large scene near the goal, then with larger parts.

Nothing is claimed that a narrowed problem does not prove: its shortest plan is proven to be optimal only if no plan of
the whole scene can be shorter (see `lower_bound`), and if it has no plan, a larger part is considered, up to the whole
scene. Nor is anything claimed about skills that planners cannot use.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, TypeAlias, assert_never

import msgspec
from msgspec.structs import replace

from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.problem.initial_state import TooManyValues
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.planning.search.step_count import has_few_steps
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from skillc_runtime.planning.unsolvability import UnsolvabilityReason

STAGE_SHARE = 0.5
"""The share of the remaining time for a narrowed problem, so that a larger one can still be tried."""

SKETCH_SHARE = 0.5
"""The same for a first plan, goal by goal."""

LARGE = 2
"""How many times as many individuals as asked for a part has for which planners need long: it is the whole scene, or
the goal names that many."""

SPARSE = 4
"""How many times as many individuals as a small scene has a scene may have that is planned with whole if few steps are
possible in it, such as on roads."""

FEW_LITERALS = 50_000
"""How many literals few steps have."""

BOUND_S = 2.0
"""The time limit for proving that a plan for a part of the scene is optimal for the whole scene."""

Pose: TypeAlias = Callable[[AbstractionSize | None], PosedProblem]
AskPlanner: TypeAlias = Callable[[PosedProblem, CancelToken], PlanResult]
Search: TypeAlias = Callable[[Problem, CancelToken], PlanResult]
Explain: TypeAlias = "Callable[[PosedProblem], UnsolvabilityReason]"
Sketch: TypeAlias = Callable[[PosedProblem, CancelToken], Solved | None]


class PlanningStages(msgspec.Struct, frozen=True):
    """Functions that pose a problem, answer it with a validated plan, search without validation, and explain failure.

    `sketch` returns some validated plan, goal by goal.

    `cancel` ends all of them together.
    """

    pose: Pose
    answer: AskPlanner
    search: Search
    explain: Explain
    sketch: Sketch
    cancel: CancelToken


def plan_in_stages(stages: PlanningStages, state: WorldState, size: AbstractionSize | None) -> PlanResult:
    """Return the answer for the smallest part of the scene that has one.

    The first part is as large as `size` says; None is the whole scene. If `size` proves, and in a small scene, the
    part grows until a plan is proven to be optimal or nothing is left out.
    """
    best: Solved | None = None
    while True:
        try:
            posed = _pose(size, state, stages)
        except (TooManyValues, Cancelled) as reason:
            return best or GaveUp(str(reason))
        if best is None and size is not None and len(posed.problem.objects) > LARGE * size.objects:
            best = _sketch(posed, stages)
        if size is None or not posed.narrowed:
            return _plan_whole_scene(best, posed, stages)
        answer = stages.answer(posed, stages.cancel.share(STAGE_SHARE))
        match answer:
            case Solved():
                rated = _rate(answer, posed, stages, state)
                best = _choose_shorter(best, _limit_claims(rated, posed))
                if rated.optimal == "proven" or not (size.proves or posed.candidate_count <= size.whole):
                    return best
            case Unsolvable():
                why = _explain_unreachable(posed, stages, state)
                if why is not None:
                    return _no_plan(why, posed)
            case GaveUp():
                if stages.cancel.reason is not None:
                    return best or answer
            case _:
                assert_never(answer)
        best = best or _sketch(posed, stages)
        size = size.wider()


def _pose(size: AbstractionSize | None, state: WorldState, stages: PlanningStages) -> PosedProblem:
    """Return the problem of a part of the scene, or of the whole scene if that is hardly harder."""
    if size is not None and len(state.individuals) <= SPARSE * size.whole:
        with suppress(TooManyValues):
            whole = stages.pose(None)
            if len(whole.problem.objects) <= size.most_kept or has_few_steps(whole.problem, FEW_LITERALS):
                return whole
    return stages.pose(size)


def _sketch(posed: PosedProblem, stages: PlanningStages) -> Solved | None:
    """Return some plan, of which nothing is claimed."""
    found = stages.sketch(posed, stages.cancel.share(SKETCH_SHARE))
    return None if found is None else _limit_claims(replace(found, left_out=posed.left_out), posed)


def _choose_shorter(known: Solved | None, found: Solved) -> Solved:
    """Return the shorter plan, the second if both are equally short, which more is known of."""
    if known is None or known.plan.duration_s >= found.plan.duration_s:
        return found
    return replace(known, at_least_s=found.at_least_s)


def _plan_whole_scene(best: Solved | None, posed: PosedProblem, stages: PlanningStages) -> PlanResult:
    """Return the answer for the whole scene, or the best answer for a part if there is none in time."""
    answer = stages.answer(posed, stages.cancel)
    match answer:
        case Solved():
            return _choose_shorter(best, _limit_claims(replace(answer, left_out=posed.left_out), posed))
        case Unsolvable():
            return _no_plan(stages.explain(posed), posed)
        case GaveUp():
            return best or answer
        case _:
            assert_never(answer)


def _limit_claims(solved: Solved, posed: PosedProblem) -> Solved:
    """Return a plan without claims about the skills and steps that were left out; an empty plan is always optimal."""
    if not posed.restricted or not solved.plan.steps:
        return solved
    if solved.optimal == "proven":
        return replace(solved, optimal="optimal for the filtered problem")
    return replace(solved, at_least_s=None)


def _no_plan(reason: UnsolvabilityReason, posed: PosedProblem) -> Unsolvable | GaveUp:
    """Return that there is no plan; this is a proof only if no skill or step was left out."""
    if posed.restricted:
        return GaveUp(reason.why, causes=reason.causes, needed=posed.restricted)
    return Unsolvable(reason.why, reason.causes)


def _rate(solved: Solved, posed: PosedProblem, stages: PlanningStages, state: WorldState) -> Solved:
    """Return a plan of a narrowed problem, rated for the whole scene."""
    found = replace(solved, left_out=posed.left_out, at_least_s=None)
    if solved.optimal != "proven":
        return replace(found, optimal="best found")
    bound = _search_lower_bound(posed, stages, state)
    least_s = bound.bound_s if isinstance(bound, Solved) else 0.0
    if least_s >= solved.plan.duration_s:
        return found
    return replace(found, optimal="optimal for the filtered problem", at_least_s=least_s or None)


def _explain_unreachable(posed: PosedProblem, stages: PlanningStages, state: WorldState) -> UnsolvabilityReason | None:
    """Return why the whole scene has no plan; None if it may have one."""
    relaxed = _relax_scene(posed, state)
    if relaxed is None or not isinstance(stages.search(relaxed, stages.cancel.share(STAGE_SHARE)), Unsolvable):
        return None
    return stages.explain(replace(posed, problem=relaxed))


def _search_lower_bound(posed: PosedProblem, stages: PlanningStages, state: WorldState) -> PlanResult | None:
    part = stages.cancel.limited(BOUND_S)
    try:
        with cancelling(part):
            problem = _relax_scene(posed, state)
            return None if problem is None else stages.search(problem, part)
    except Cancelled:
        return None


def _relax_scene(posed: PosedProblem, state: WorldState) -> Problem | None:
    """Return the whole scene as a relaxed problem; what makes it is slow to import, and needed for large scenes."""
    from skillc_runtime.planning.abstraction.lower_bound import relax_scene

    return relax_scene(posed, state)
