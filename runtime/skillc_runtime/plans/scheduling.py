"""The times of a plan whose steps begin as soon as those are over that they have to wait for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import assert_never

from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import Plan
from skillc_runtime.planning.schedule import Schedule, TimedStep
from skillc_runtime.planning.validation import apply_step, compute_step_duration_s
from skillc_runtime.plans.order import Arrangement, InOrder, Together, arranged
from skillc_runtime.world.state.world_state import WorldState


def scheduled(plan: Plan, library: SkillLibrary, state: WorldState) -> Schedule:
    """Return the earliest times for the steps of a plan; PlanError when it does not work from this world.

    They are those of the body that runs the plan: its parts begin when the part before them is over.
    """
    lasting = durations_s(plan, library, state)
    times = sorted(_begins(arranged(plan, library, state), Fraction(0), lasting), key=lambda each: each[::-1])
    return Schedule(
        tuple(TimedStep(plan.steps[number], float(start), float(lasting[number])) for number, start in times)
    )


def durations_s(plan: Plan, library: SkillLibrary, state: WorldState) -> tuple[Fraction, ...]:
    """Return how long the steps of a plan are expected to last, in seconds; PlanError when it does not work."""
    before, found = state, []
    for step in plan.steps:
        found.append(compute_step_duration_s(step, library, state, before))
        state = apply_step(step, library, state)
    return tuple(found)


def _begins(part: Arrangement, start: Fraction, lasting: Sequence[Fraction]) -> Iterator[tuple[int, Fraction]]:
    """Yield the steps of a part that begins at a time, each with the time at which it begins, in seconds."""
    match part:
        case int():
            yield part, start
        case InOrder(parts):
            for each in parts:
                begins = tuple(_begins(each, start, lasting))
                yield from begins
                start = max((begin + lasting[number] for number, begin in begins), default=start)
        case Together(parts):
            for each in parts:
                yield from _begins(each, start, lasting)
        case _:
            assert_never(part)
