"""One plan for several tasks: who comes first where they want the same device, and when each of them is done."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import permutations
from typing import TypeAlias

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import And, Condition
from skillc_model.skills import SkillLibrary, TaskPart
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.makespan.lower_bound import TOLERANCE_S
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.plan import GaveUp, Plan, Solved, Step, Unsolvable
from skillc_runtime.planning.schedule import PlanAnswer, Schedule, Scheduled
from skillc_runtime.planning.validation import (
    PlanError,
    apply_effects,
    apply_step,
    compute_work_s,
    follow_plan,
    validate,
)
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.world_state import WorldState

MOST_PERMUTED = 4
"""Of at most so many tasks all orders are tried; of more, that in which they are named, and that of their times."""
MOST_STEPS = 60
"""A plan with more steps is kept as it was found: trying which of them a task needs would take long."""

Planned: TypeAlias = "Solved | Scheduled"
PlanFrom: TypeAlias = Callable[[WorldState, Condition], PlanAnswer]
"""Plans from a version of the world to a goal."""


class SeveralTasks(msgspec.Struct, frozen=True):
    """Tasks that are planned as one, from `state`; the first has precedence.

    `library` and `goal` are those with which plans are validated.
    """

    parts: tuple[TaskPart, ...]
    library: SkillLibrary
    state: WorldState
    goal: Condition

    def schedule_of(self, answer: Planned) -> Schedule:
        """Return the times of the steps of a plan, the earliest ones if it has none; PlanError if it does not work."""
        if isinstance(answer, Scheduled):
            return answer.schedule
        return schedule_plan(answer.plan, self.library, self.state)

    def done_s(self, schedule: Schedule) -> tuple[float, ...]:
        """Return from when on the goal of each task holds until the end of a schedule, in s."""
        library, state = foresee(self.library, self.state, self.goal)
        done: list[float | None] = [0.0 if evaluate(each.goal, state, {}) else None for each in self.parts]
        for timed in sorted(schedule.steps, key=lambda each: each.end_s):
            state = apply_effects(timed.step, library, state)
            for number, part in enumerate(self.parts):
                if not evaluate(part.goal, state, {}):
                    done[number] = None
                elif done[number] is None:
                    done[number] = timed.end_s
        return tuple(schedule.makespan_s if each is None else each for each in done)

    def late_s(self, done_s: Sequence[float]) -> tuple[float, ...]:
        """Return by how much each task is done too late, in s."""
        limits = (each.within_s for each in self.parts)
        late = (0.0 if limit is None else done - limit for done, limit in zip(done_s, limits, strict=True))
        return tuple(each if each > TOLERANCE_S else 0.0 for each in late)


def plan_several(tasks: SeveralTasks, plan: PlanFrom, minimises_makespan: bool) -> PlanAnswer:
    """Return a plan for several tasks at once.

    It is the plan of least work or makespan for all, its steps in that order of the tasks which is best: few are late,
    the makespan is short if that is minimised, those that come first are done early. Where a task is late in it, plans
    are tried as well that reach one goal after the other.
    """
    answer = plan(tasks.state, _all(tasks.parts))
    if not isinstance(answer, Solved | Scheduled) or answer.plan.branches:
        return answer
    rating = _Rating(tasks, minimises_makespan)
    best = min((answer, *_reorder(answer, tasks)), key=rating.of)
    if not any(rating.late_s(best)):
        return best
    return min((best, *_one_by_one(best, tasks, plan)), key=rating.of)


class _Rating(msgspec.Struct, frozen=True):
    tasks: SeveralTasks
    minimises_makespan: bool

    def late_s(self, answer: Planned) -> tuple[float, ...]:
        return self.tasks.late_s(self.tasks.done_s(self.tasks.schedule_of(answer)))

    def of(self, answer: Planned) -> tuple[object, ...]:
        schedule = self.tasks.schedule_of(answer)
        done_s = self.tasks.done_s(schedule)
        late_s = self.tasks.late_s(done_s)
        makespan_s = schedule.makespan_s if self.minimises_makespan else 0.0
        return sum(each > 0.0 for each in late_s), late_s, makespan_s, done_s


def _orders(parts: Sequence[TaskPart]) -> Iterator[tuple[int, ...]]:
    """Yield orders of tasks, by index."""
    named = range(len(parts))
    if len(parts) <= MOST_PERMUTED:
        yield from permutations(named)
        return
    yield tuple(named)
    yield tuple(sorted(named, key=lambda each: (parts[each].within_s is None, parts[each].within_s or 0.0)))


def _reorder(answer: Planned, tasks: SeveralTasks) -> Iterator[Planned]:
    """Yield the same steps in other orders, which take as much work: those of one task, then those of the next."""
    steps = answer.plan.steps
    if len(steps) > MOST_STEPS:
        return
    needed = [_find_needed(part.goal, steps, tasks) for part in tasks.parts]
    for order in _orders(tasks.parts):
        numbers = dict.fromkeys(number for part in order for number in needed[part])
        numbers |= dict.fromkeys(range(len(steps)))
        found = _with_steps(answer, tuple(steps[each] for each in numbers), tasks)
        if found is not None and found.plan.duration_s == answer.plan.duration_s:
            yield found


def _find_needed(goal: Condition, steps: Sequence[Step], tasks: SeveralTasks) -> tuple[int, ...]:
    """Return the steps, by index, that a goal needs: without others, and what needs them in turn, it is reached too.

    This is action elimination, as in Nakhost and Müller, "Action elimination and plan neighborhood graph search", 2010.
    """
    kept = tuple(range(len(steps)))
    for number in range(len(steps)):
        if number in kept:
            rest, end = _follow([each for each in kept if each != number], steps, tasks)
            kept = rest if evaluate(goal, end, {}) else kept
    return kept


def _follow(numbers: Iterable[int], steps: Sequence[Step], tasks: SeveralTasks) -> tuple[tuple[int, ...], WorldState]:
    """Return those of some steps that work one after the other, by index, and the world after them."""
    library, state = foresee(tasks.library, tasks.state, tasks.goal)
    done = []
    for number in numbers:
        try:
            state = apply_step(steps[number], library, state)
        except PlanError:
            continue
        done.append(number)
    return tuple(done), state


def _with_steps(answer: Planned, steps: tuple[Step, ...], tasks: SeveralTasks) -> Planned | None:
    """Return an answer with other steps that lead to the goal; None if they do not."""
    try:
        validate(Plan(steps, 0.0), tasks.library, tasks.state, tasks.goal)
        plan = replace(
            answer.plan, steps=steps, duration_s=compute_work_s(Plan(steps, 0.0), tasks.library, tasks.state)
        )
        if isinstance(answer, Solved):
            return replace(answer, plan=plan)
        schedule = schedule_plan(plan, tasks.library, tasks.state)
    except PlanError:
        return None
    if schedule.makespan_s <= answer.schedule.makespan_s + TOLERANCE_S:
        return replace(answer, plan=plan, schedule=schedule)
    at_least_s = answer.schedule.makespan_s if answer.optimal == "proven" else answer.at_least_s
    return replace(answer, plan=plan, schedule=schedule, optimal="best found", at_least_s=at_least_s)


def _one_by_one(answer: Planned, tasks: SeveralTasks, plan: PlanFrom) -> Iterator[Planned]:
    """Yield plans that reach the goal of one task, then that of the next one as well, in several orders."""
    least_s = answer.plan.duration_s if isinstance(answer, Solved) and answer.optimal == "proven" else None
    for order in _orders(tasks.parts):
        steps = _plan_in_turn([tasks.parts[each] for each in order], tasks, plan)
        found = None if steps is None else _with_steps(answer, steps, tasks)
        if isinstance(found, Solved) and found.plan.duration_s > answer.plan.duration_s:
            found = replace(found, optimal="best found", at_least_s=least_s or answer.at_least_s)
        if found is not None:
            yield found


def _plan_in_turn(parts: Sequence[TaskPart], tasks: SeveralTasks, plan: PlanFrom) -> tuple[Step, ...] | None:
    """Return the steps to one goal after the other, each with those before it; None if no plan was found for one."""
    steps, state = tuple[Step, ...](), tasks.state
    for count in range(1, len(parts) + 1):
        answer = plan(state, _all(parts[:count]))
        if isinstance(answer, Unsolvable | GaveUp) or answer.plan.branches:
            return None
        steps += answer.plan.steps
        try:
            state = follow_plan(answer.plan, *foresee(tasks.library, state, tasks.goal))[-1]
        except PlanError:
            return None
    return steps


def _all(parts: Iterable[TaskPart]) -> Condition:
    return And(tuple(each.goal for each in parts))


def refuse_late_tasks(answer: PlanAnswer, tasks: SeveralTasks) -> PlanAnswer:
    """Return an answer, or if a task is expected to be done too late in its plan, that no other plan was found."""
    if not isinstance(answer, Solved | Scheduled) or answer.plan.branches:
        return answer
    done_s = tasks.done_s(tasks.schedule_of(answer))
    for part, done, late in zip(tasks.parts, done_s, tasks.late_s(done_s), strict=True):
        if late:
            found = f"in the best plan that was found it is done after {done:g} s"
            return GaveUp(f"`{part.name}` has to be done within {part.within_s:g} s, and {found}")
    return answer
