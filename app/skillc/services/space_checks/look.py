"""Looks at a task in space, as `skillc plan` does: plans for its goal, or walks through its body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from skillc.services.planning import prepare_planners
from skillc.services.space_checks.problems import SpaceProblem
from skillc_model import tree
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary, Task
from skillc_model.traversal import find_calls
from skillc_runtime.cancellation import CancelToken, cancelling
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.execution.refinement.situation import begin_at_home
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.planning.plan import Excluded, GaveUp, PlanResult, Solved, Step
from skillc_runtime.planning.planners import Planners
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Looked:
    """What a look has found, and the skills that the plans or the body call on which that depends."""

    problem: SpaceProblem | None
    skills: frozenset[str]


def look_at_task(library: SkillLibrary, state: WorldState, task: Task, cancel: CancelToken, use_cache: bool) -> Looked:
    """Return which step of a task does not go in a version of the world; Cancelled if `cancel` ends the look."""
    if task.goal is not None:
        found = _look_at_goal(library, state, task.goal, prepare_planners(use_cache), cancel)
    else:
        assert task.body is not None, "a task has a goal or a body"
        with cancelling(cancel):
            found = _look_at_body(library, state, task.body)
    cancel.check()
    return found


def _look_at_goal(
    library: SkillLibrary, state: WorldState, goal: Condition, planners: Planners, cancel: CancelToken
) -> Looked:
    skills = set[str]()

    def plan(without: Sequence[Excluded]) -> PlanResult:
        answer = solve(library, state, goal, planners.for_work, cancel, without)
        skills.update(each.skill for each in answer.plan.steps) if isinstance(answer, Solved) else None
        return answer

    answer, found = plan_in_space(library, state, plan, cancel)
    if found is None or found.failed is None or found.failure is None or not found.failure.is_in_space:
        return Looked(None, frozenset(skills))
    needed = answer.needed if isinstance(answer, GaveUp) else ()
    certain = bool(needed) and all(each.kind == "steps" for each in needed) and not _has_unseen(found)
    step = _describe_step(found.failed, library, state)
    return Looked(SpaceProblem(step, found.failure.message, certain), frozenset(skills))


def _has_unseen(found: PlanRefinement) -> bool:
    return any(each.unseen for each in found.steps) or bool(found.unseen)


def _describe_step(step: Step, library: SkillLibrary, state: WorldState) -> str:
    """Return a step with the arguments that its skill does not look up itself."""
    given = [each.name for each in library.skills[step.skill].parameters if each.direction == "in"]
    named = ", ".join(state.vocabulary.short(step.arguments[name]) for name in given if name in step.arguments)
    return f"{step.skill}({named})"


def _look_at_body(library: SkillLibrary, state: WorldState, body: tree.Node) -> Looked:
    walk, calls = Walk(library), list(find_calls(body))
    goes = next(walk.go(body, begin_at_home(state), Scope({})), None) is not None
    failure, skills = walk.furthest, frozenset(each.skill for each in calls)
    if goes or failure is None or not failure.is_in_space:
        return Looked(None, skills)
    return Looked(_problem_of(failure, calls, certain=not walk.unseen), skills)


def _problem_of(failure: SpaceFailure, calls: Sequence[tree.Call], *, certain: bool) -> SpaceProblem:
    place = next((number for number, each in enumerate(calls) if each.source == failure.source), None)
    step, *inside = failure.within
    return SpaceProblem(step, failure.message if inside else failure.why, certain, place)
