"""Schedules a plan: each step starts when the steps that must precede it have ended."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from typing import TypeVar, assert_never

from msgspec.structs import replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.arrangement import Arrangement, InParallel, InSeries, arrange_plan
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import Plan, Solved
from skillc_runtime.planning.schedule import Schedule, Scheduled, TimedStep
from skillc_runtime.planning.validation import apply_step, compute_step_duration_s
from skillc_runtime.world.state.world_state import WorldState

AnswerT = TypeVar("AnswerT", bound=Solved | Scheduled)


def schedule_plan(plan: Plan, library: SkillLibrary, state: WorldState) -> Schedule:
    """Return the earliest times for the steps of a plan; PlanError if it does not work from `state`.

    They are those of the body that runs the plan: each step starts when those that it waits for have ended.
    """
    durations = step_durations_s(plan, library, state)
    times = sorted(
        _start_times(arrange_plan(plan, library, state), Fraction(0), durations), key=lambda each: each[::-1]
    )
    return Schedule(
        tuple(TimedStep(plan.steps[number], float(start), float(durations[number])) for number, start in times)
    )


def keep_apart(answer: AnswerT, pairs: Iterable[tuple[int, int]], library: SkillLibrary, state: WorldState) -> AnswerT:
    """Return an answer in which pairs of steps of the plan, by index, do not run at the same time.

    A schedule that takes longer by this is not proved optimal any more: some other plan may take as long as it took.
    """
    apart = frozenset(pairs)
    if not apart:
        return answer
    plan: Plan = replace(answer.plan, apart=apart)
    if not isinstance(answer, Scheduled):
        return replace(answer, plan=plan)
    before_s, schedule = answer.schedule.makespan_s, schedule_plan(plan, library, state)
    if schedule.makespan_s <= before_s:
        return replace(answer, plan=plan, schedule=schedule)
    least_s = before_s if answer.optimal == "proven" else answer.at_least_s
    return replace(answer, plan=plan, schedule=schedule, optimal="best found", at_least_s=least_s)


def step_durations_s(plan: Plan, library: SkillLibrary, state: WorldState) -> tuple[Fraction, ...]:
    """Return the expected durations of the steps of a plan in s; PlanError if it does not work from `state`."""
    library, state = foresee(library, state)
    before, found = state, []
    for step in plan.steps:
        found.append(compute_step_duration_s(step, library, state, before))
        state = apply_step(step, library, state)
    return tuple(found)


def _start_times(part: Arrangement, start: Fraction, durations: Sequence[Fraction]) -> Iterator[tuple[int, Fraction]]:
    """Yield the steps of a part that starts at `start`, each with the time at which it starts, in s."""
    match part:
        case int():
            yield part, start
        case InSeries(parts):
            for each in parts:
                starts = tuple(_start_times(each, start, durations))
                yield from starts
                start = max((begin + durations[number] for number, begin in starts), default=start)
        case InParallel(parts, after):
            ends: list[Fraction] = []
            for index, each in enumerate(parts):
                begin = max((ends[other] for other in after[index]), default=start) if after else start
                starts = tuple(_start_times(each, begin, durations))
                yield from starts
                ends.append(max(time + durations[number] for number, time in starts))
        case _:
            assert_never(part)
