"""The times of a plan whose steps begin as soon as those are over that they have to wait for."""

from __future__ import annotations

from skillc_compiler.library.pddl.costs import ASSUMED_SECONDS, UNITS_PER_SECOND, units
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.schedule import Schedule, TimedStep
from skillc_runtime.planning.validate import bindings_of
from skillc_runtime.plans.order import waited_for
from skillc_runtime.world.expressions import EvaluationError, value_of
from skillc_runtime.world.state import WorldState


def scheduled(plan: Plan, library: SkillLibrary, state: WorldState) -> Schedule:
    """Return the earliest times for the steps of a plan; PlanError when it does not work from this world.

    A step waits for those that change what it reads, read what it changes, settle the same facts or lock the same
    device. Which steps these are is part of the plan; with other steps all may be over earlier.
    """
    timed: list[TimedStep] = []
    for step, earlier in zip(plan.steps, waited_for(plan, library, state), strict=True):
        start_s = max((timed[each].end_s for each in earlier), default=0.0)
        timed.append(TimedStep(step, start_s, expected_s(step, library, state)))
    return Schedule(tuple(sorted(timed, key=lambda each: each.start_s)))


def expected_s(step: Step, library: SkillLibrary, state: WorldState) -> float:
    """Return how long a step is expected to last, in whole tenths of a second, by the world before the plan."""
    duration = library.skills[step.skill].duration
    if duration is None:
        return ASSUMED_SECONDS
    try:
        seconds = value_of(duration, state, bindings_of(step, library, state))
    except EvaluationError:
        return ASSUMED_SECONDS
    return (units(seconds) if isinstance(seconds, int | float) else units(ASSUMED_SECONDS)) / UNITS_PER_SECOND
