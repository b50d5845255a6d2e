"""Simulates a schedule in the world model before anything moves, since no temporal planner is trusted.

Time advances from event to event. When a step starts, its preconditions must hold; while it runs, its holds must hold
after every change; when it ends, its effects are applied. Steps that end at a time do so before others start then.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.pddl.devices import locked_parameters
from skillc_model.read_write import ReadWriteSet
from skillc_model.skills import Implementation, SkillLibrary
from skillc_runtime.planning.arrangement import read_write_set
from skillc_runtime.planning.deciding_reads import DecidingReads
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.schedule import Schedule, TimedStep
from skillc_runtime.planning.validation import (
    PlanError,
    apply_effects,
    check_goal_reached,
    compute_step_duration_s,
    filter_held_implementations,
    find_startable_implementations,
)
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

INSTANT_S = 1e-6
"""Times that differ by at most this are equal."""


class _ActiveStep(msgspec.Struct, frozen=True):
    """A running step, with the implementations that may be running it."""

    step: Step
    facts: ReadWriteSet
    implementations: tuple[Implementation, ...]


def simulate_schedule(schedule: Schedule, library: SkillLibrary, state: WorldState, goal: Condition) -> WorldState:
    """Return the world after a schedule.

    PlanError if a step starts before time 0 or does not last as long as expected; if it cannot start, or one of its
    holds is broken while it runs; if it overlaps with one that locks the same device or settles the same facts, or
    starts while one runs that changes what it reads; or if the goal does not hold at the end.
    """
    return _ScheduleSimulation(schedule, library, state).run(goal)


class _ScheduleSimulation:
    def __init__(self, schedule: Schedule, library: SkillLibrary, state: WorldState) -> None:
        self._steps, self._library, self._state = schedule.steps, library, state
        self._before, self._locked = state, locked_parameters(library)
        self._active: dict[int, _ActiveStep] = {}

    def run(self, goal: Condition) -> WorldState:
        """Simulate the schedule and return the world after it."""
        for number, timed in enumerate(self._steps, 1):
            self._check_times(number, timed)
        starts = _group_by_instant(each.start_s for each in self._steps)
        ends = _group_by_instant(each.end_s for each in self._steps)
        for instant in sorted(starts.keys() | ends.keys()):
            starting, ending = starts.get(instant, ()), ends.get(instant, ())
            for number in ending:
                if number in self._active:
                    self._end(number)
            self._check_holds()
            for number in starting:
                self._start(number)
                if number in ending:
                    self._end(number)
                    self._check_holds()
        return check_goal_reached(goal, self._state)

    def _check_times(self, number: int, timed: TimedStep) -> None:
        with _name_step_in_errors(number, timed.step):
            if timed.step.skill not in self._library.skills:
                raise PlanError("there is no such skill")
            if timed.start_s < -INSTANT_S:
                raise PlanError("it starts before the plan does")

    def _start(self, number: int) -> None:
        step, library, state = self._steps[number - 1].step, self._library, self._state
        with _name_step_in_errors(number, step):
            implementations = find_startable_implementations(step, library, state)
            expected_s = float(compute_step_duration_s(step, library, state, self._before))
            if abs(self._steps[number - 1].duration_s - expected_s) > INSTANT_S:
                raise PlanError(f"it takes {expected_s:g} s, not {self._steps[number - 1].duration_s:g}")
            written = DecidingReads(fact for active in self._active.values() for fact in active.facts.writes)
            change = state, apply_effects(step, library, state)
            facts = read_write_set(step, library, self._locked, change, written)
            for other, active in self._active.items():
                shared = active.facts.shares_with(facts)
                if shared is not None:
                    raise PlanError(f"it overlaps with step {other}, {active.step.skill}: {shared}")
                if facts.is_disturbed_by(active.facts):
                    raise PlanError(f"it starts while step {other}, {active.step.skill}, changes what it reads")
            self._active[number] = _ActiveStep(step, facts, implementations)

    def _end(self, number: int) -> None:
        active = self._active.pop(number)
        with _name_step_in_errors(number, active.step):
            self._state = apply_effects(active.step, self._library, self._state)

    def _check_holds(self) -> None:
        for number, active in self._active.items():
            with _name_step_in_errors(number, active.step):
                held = filter_held_implementations(active.step, active.implementations, self._library, self._state)
                self._active[number] = replace(active, implementations=held)


@contextmanager
def _name_step_in_errors(number: int, step: Step) -> Iterator[None]:
    try:
        yield
    except (PlanError, EvaluationError, WorldError) as reason:
        raise PlanError(f"step {number}, {step.skill}: {reason}") from reason


def _group_by_instant(times_s: Iterable[float]) -> dict[int, list[int]]:
    """Return the positions of times, from 1, grouped by equal times."""
    found: dict[int, list[int]] = {}
    for number, time_s in enumerate(times_s, 1):
        found.setdefault(round(time_s / INSTANT_S), []).append(number)
    return found
