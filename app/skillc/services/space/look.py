"""Looks at a task in space, as `skillc plan` does: plans for its goal, or walks through its body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from skillc.services.planning.planning import prepare_planners
from skillc.services.space.cure import find_cure
from skillc.services.tasks.space_problems import SpaceProblem
from skillc_model import tree
from skillc_model.conditions import Condition, Individual
from skillc_model.skills import SkillLibrary, Task
from skillc_model.traversal import find_calls
from skillc_model.traversal import walk as walk_parts
from skillc_runtime.cancellation import CancelToken, cancelling
from skillc_runtime.execution.refinement.plan_refinement import refine_plan
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
        return _look_at_goal(library, state, task.goal, prepare_planners(use_cache), cancel)
    assert task.body is not None, "a task has a goal or a body"
    return _look_at_body(library, state, task.body, cancel)


def _look_at_goal(
    library: SkillLibrary, state: WorldState, goal: Condition, planners: Planners, cancel: CancelToken
) -> Looked:
    plans: list[tuple[Step, ...]] = []

    def plan(without: Sequence[Excluded]) -> PlanResult:
        answer = solve(library, state, goal, planners.for_work, cancel, without)
        plans.extend([answer.plan.steps] if isinstance(answer, Solved) else [])
        return answer

    answer, found = plan_in_space(library, state, plan, cancel)
    cancel.check()
    skills = frozenset(step.skill for steps in plans for step in steps)
    failure = None if found is None else found.failure
    if found is None or found.failed is None or failure is None or not failure.is_in_space:
        return Looked(None, skills)

    def goes(there: WorldState) -> bool:
        return refine_plan(library, there, plans[-1]).failed is None

    needed = answer.needed if isinstance(answer, GaveUp) else ()
    seen = not found.unseen and not any(each.unseen for each in found.steps)
    certain = seen and bool(needed) and all(each.kind == "steps" for each in needed)
    things = _given(found.failed, library)
    named = f"{found.failed.skill}({', '.join(map(state.vocabulary.short, things))})"
    cure = find_cure(state, things, failure, goes, cancel)
    return Looked(SpaceProblem(named, failure.message, certain, None, cure), skills)


def _given(step: Step, library: SkillLibrary) -> list[str]:
    """Return the arguments of a step that its skill does not look up itself."""
    given = (each.name for each in library.skills[step.skill].parameters if each.direction == "in")
    return [step.arguments[name] for name in given if name in step.arguments]


def _look_at_body(library: SkillLibrary, state: WorldState, body: tree.Node, cancel: CancelToken) -> Looked:
    def goes(there: WorldState) -> bool:
        return next(Walk(library).go(body, begin_at_home(there), Scope({})), None) is not None

    walk, calls = Walk(library), list(find_calls(body))
    skills = frozenset(each.skill for each in calls)
    with cancelling(cancel):
        went = next(walk.go(body, begin_at_home(state), Scope({})), None) is not None
    failure = walk.furthest
    if went or failure is None or not failure.is_in_space:
        return Looked(None, skills)
    place = next((number for number, each in enumerate(calls) if each.source == failure.source), None)
    parts = () if place is None else walk_parts(calls[place])
    named = [each.iri for each in parts if isinstance(each, Individual)]
    step, *inside = failure.within
    why = failure.message if inside else failure.why
    cure = find_cure(state, named, failure, goes, cancel)
    return Looked(SpaceProblem(step, why, not walk.unseen, place, cure), skills)
