"""Looks at a task in space, as `skillc plan` does: plans for its goal, or walks through its body."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

from skillc.services.planning.planning import prepare_planners
from skillc.services.space.spread import PlannedPart, find_displacement, goes_everywhere
from skillc.services.tasks.space_problems import SpaceProblem
from skillc_model import tree
from skillc_model.conditions import Condition, Individual
from skillc_model.skills import SkillLibrary, Task
from skillc_model.traversal import find_calls
from skillc_model.traversal import walk as walk_parts
from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.collision.solid_geoms import find_overlap_m
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement, refine_plan
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.execution.refinement.scope import call_of
from skillc_runtime.execution.refinement.situation import Situation, begin_at_home
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.planning.objectives.always import library_that_keeps
from skillc_runtime.planning.plan import Excluded, GaveUp, PlanResult, Solved, Step
from skillc_runtime.planning.schedule import Planners
from skillc_runtime.planning.solve import solve
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.occupants import read_occupants
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.terms import OFFSET, POSITION
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

DISTANCES_M = (0.05, 0.1, 0.15, 0.2)
"""How far away places are that are tried, in each direction of the numbers that say where the thing is."""

ROOM_M = 0.02
"""How far from the place that is proposed the thing may be, along each of these numbers, so that all still goes."""


@dataclass(frozen=True, slots=True)
class Looked:
    """What a look has found, and the skills that the plans or the body call on which that depends."""

    problem: SpaceProblem | None
    skills: frozenset[str]


def look_at_task(library: SkillLibrary, state: WorldState, task: Task, cancel: CancelToken, use_cache: bool) -> Looked:
    """Return which step of a task does not go in a version of the world; Cancelled if `cancel` ends the look."""
    if task.goal is not None:
        kept = library_that_keeps(library, task.always)
        return _look_at_goal(kept.library, state, kept.goal(task.goal), prepare_planners(use_cache), cancel)
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
    if found is None:
        return Looked(None, skills)
    if found.failed is None:
        parts = [
            PlannedPart(call_of(each.step, library), each.before, tuple(each.step.arguments.values()), each.motions)
            for each in found.steps
        ]
        goes = _AnyPlace(library, state, plans[-1], found).goes
        return Looked(_find_displaced(library, state, parts, goes, cancel), skills)
    failure = found.failure
    if failure is None or not failure.is_in_space:
        return Looked(None, skills)

    needed = answer.needed if isinstance(answer, GaveUp) else ()
    seen = not found.unseen and not any(each.unseen for each in found.steps)
    certain = seen and bool(needed) and all(each.kind == "steps" for each in needed)
    things = _given(found.failed, library)
    named = _show(found.failed.skill, things, state)
    cure = find_cure(state, things, failure, _AnyPlace(library, state, plans[-1], found).goes, cancel)
    return Looked(SpaceProblem(named, failure.message, certain, None, cure), skills)


@dataclass(frozen=True, slots=True)
class _AnyPlace:
    """Whether the steps of a plan go with other places of things than those with which one of them does not."""

    library: SkillLibrary
    state: WorldState
    steps: tuple[Step, ...]
    found: PlanRefinement

    def goes(self, changes: Sequence[SetProperty]) -> bool:
        """Whether all steps go: first those from the failed one on, after those before it as they went."""
        there = _changed(self.state, changes)
        return there is not None and self._goes_on(changes) and self._go_all(self.steps, begin_at_home(there))

    def _goes_on(self, changes: Sequence[SetProperty]) -> bool:
        before, done = self.found.before, len(self.found.steps)
        if before is None or self.steps[done : done + 1] != (self.found.failed,):
            return True
        there = _changed(before.state, changes)
        if there is None or any(_value(before.state, each) != _value(self.state, each) for each in changes):
            return True
        return self._go_all(self.steps[done:], replace(before, state=there))

    def _go_all(self, steps: tuple[Step, ...], begin: Situation) -> bool:
        return refine_plan(self.library, begin.state, steps, begin).failed is None


def _given(step: Step, library: SkillLibrary) -> list[str]:
    """Return the arguments of a step that its skill does not look up itself."""
    given = (each.name for each in library.skills[step.skill].parameters if each.direction == "in")
    return [step.arguments[name] for name in given if name in step.arguments]


def _show(skill: str, things: Iterable[str], state: WorldState) -> str:
    return f"{skill}({', '.join(map(state.vocabulary.short, things))})"


def _look_at_body(library: SkillLibrary, state: WorldState, body: tree.Node, cancel: CancelToken) -> Looked:
    def goes(changes: Sequence[SetProperty]) -> bool:
        there = _changed(state, changes)
        return there is not None and next(Walk(library).go(body, begin_at_home(there), Scope({})), None) is not None

    walk, calls = Walk(library), list(find_calls(body))
    skills = frozenset(each.skill for each in calls)
    with cancelling(cancel):
        end = next(walk.go(body, begin_at_home(state), Scope({})), None)
    if end is not None:
        used = dict.fromkeys(each.iri for call in calls for each in walk_parts(call) if isinstance(each, Individual))
        part = PlannedPart(body, begin_at_home(state), tuple(used), end.motions)
        return Looked(_find_displaced(library, state, [part], goes, cancel), skills)
    failure = walk.furthest
    if failure is None or not failure.is_in_space:
        return Looked(None, skills)
    place = next((number for number, each in enumerate(calls) if each.source == failure.source), None)
    parts = () if place is None else walk_parts(calls[place])
    named = [each.iri for each in parts if isinstance(each, Individual)]
    step, *inside = failure.within
    why = failure.message if inside else failure.why
    cure = find_cure(state, named, failure, goes, cancel)
    return Looked(SpaceProblem(step, why, not walk.unseen, place, cure), skills)


def _find_displaced(
    library: SkillLibrary,
    state: WorldState,
    parts: Iterable[PlannedPart],
    goes: Callable[[Sequence[SetProperty]], bool],
    cancel: CancelToken,
) -> SpaceProblem | None:
    """Return which part, all of which go, does not with a thing where that may really be; None if all do."""

    def goes_there(changes: Sequence[SetProperty]) -> bool:
        return goes_everywhere(library, part, changes, displaced) and goes(changes)

    with cancelling(cancel):
        found = find_displacement(library, parts)
    if found is None:
        return None
    part, displaced, failure = found
    cure = find_cure(state, [displaced.thing], failure, goes_there, cancel, 0.0)
    step, *inside = failure.within
    named = _show(step, [displaced.thing], state)
    return SpaceProblem(named, failure.message if inside else failure.why, False, None, cure, displaced.text)


def find_cure(
    state: WorldState,
    things: Iterable[str],
    failure: SpaceFailure,
    goes: Callable[[Sequence[SetProperty]], bool],
    cancel: CancelToken,
    room_m: float = ROOM_M,
) -> str:
    """Return with which place of a thing all goes, as a sentence: of the first of some things that stands somewhere.

    `goes` is whether all goes after changes of the state, which may not be possible.
    Before it comes what a failure says to be in the way. All goes as well with the thing up to room_m from there.
    Places are tried from the nearest on, and those left out at which it would lie deeper in another thing. Empty if
    none was found in half of the time that `cancel` leaves.
    """
    standing = [each.individual for each in read_occupants(state) if any(_numbers(state, each.individual))]
    given = [each for each in things if each in standing][:1]
    blocked = failure.cause in ("in-the-way", "no-grasp-or-place")
    words = {each.rstrip(".,;:") for each in failure.why.split()} if blocked else set[str]()
    blocking = [each for each in dict.fromkeys(standing) if state.vocabulary.short(each) in words and each not in given]
    try:
        with cancelling(cancel.share(0.5)):
            return next(filter(None, (_find_place(state, each, goes, room_m) for each in (*blocking, *given))), "")
    except Cancelled:
        return ""


def _find_place(state: WorldState, thing: str, goes: Callable[[Sequence[SetProperty]], bool], room_m: float) -> str:
    short, before_m, numbers = state.vocabulary.short(thing), find_overlap_m(state, thing), dict(_numbers(state, thing))
    for distance_m, (name, stated_m), sign in product(DISTANCES_M, numbers.items(), (1.0, -1.0)):
        to_m = round(stated_m + sign * distance_m, 4)
        there = _changed(state, [SetProperty(thing, name, to_m)])
        if there is None or find_overlap_m(there, thing) > before_m:
            continue
        if all(map(goes, _list_about(thing, name, {**numbers, name: to_m}, room_m))):
            return f"with {short} moved by {distance_m:g} m, to {local_name(name)} {to_m:g}, all steps go"
    return ""


def _list_about(
    thing: str, name: str, numbers: Mapping[str, float], room_m: float
) -> Iterator[tuple[SetProperty, ...]]:
    """Yield what brings a thing along an axis to a place, and with it so much to each side."""
    ways_m = (room_m, -room_m) if room_m else ()
    beside = ({each: numbers[each] + way_m} for each, way_m in product(numbers, ways_m))
    for other in ({}, *beside):
        yield tuple(SetProperty(thing, each, to_m) for each, to_m in {name: numbers[name], **other}.items())


def _numbers(state: WorldState, thing: str) -> Iterator[tuple[str, float]]:
    """Yield the properties that say where a thing is along an axis, in m."""
    for name in (*POSITION, *OFFSET):
        value = state.value(thing, name)
        if isinstance(value, int | float):
            yield name, float(value)


def _changed(state: WorldState, changes: Sequence[SetProperty]) -> WorldState | None:
    try:
        return WorldModel(state).commit(list(changes)).after
    except (WorldError, FrameError):
        return None


def _value(state: WorldState, change: SetProperty) -> Value | None:
    return state.value(change.individual, change.property)
