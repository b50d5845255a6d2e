"""Plays a schedule in the world model before anything moves: no temporal planner is trusted.

Time passes from event to event. When a step begins, its conditions must hold; while it runs, what it holds on to must
hold after every change; when it ends, its effects come about. What ends at a time has ended for what begins then.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.pddl.devices import devices
from skillc_compiler.library.skills import Implementation, SkillLibrary
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
from skillc_runtime.plans.order import touched_by
from skillc_runtime.plans.touched import Touched
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

INSTANT_S = 1e-6
"""Times that are no further apart are one."""


@dataclass(frozen=True, slots=True)
class _Active:
    """A step that runs, with the implementations that may be running it."""

    step: Step
    touched: Touched
    implementations: tuple[Implementation, ...]


def rehearse(schedule: Schedule, library: SkillLibrary, state: WorldState, goal: Condition) -> WorldState:
    """Return the world after a schedule.

    PlanError when a step begins before the schedule does or does not last as long as it is expected to; when it cannot
    begin, or what it holds on to is lost while it runs; when it runs beside one that locks the same device or settles
    the same facts, or begins while one runs that changes what it reads; or when the goal does not hold in the end.
    """
    return _Rehearsal(schedule, library, state).play(goal)


class _Rehearsal:
    def __init__(self, schedule: Schedule, library: SkillLibrary, state: WorldState) -> None:
        self._steps, self._library, self._state = schedule.steps, library, state
        self._before, self._locked = state, devices(library)
        self._active: dict[int, _Active] = {}

    def play(self, goal: Condition) -> WorldState:
        """Go through the schedule and return the world after it."""
        for number, timed in enumerate(self._steps, 1):
            self._check_times(number, timed)
        begins, ends = (
            _by_instant(each.start_s for each in self._steps),
            _by_instant(each.end_s for each in self._steps),
        )
        for instant in sorted(begins.keys() | ends.keys()):
            beginning, ending = begins.get(instant, ()), ends.get(instant, ())
            for number in ending:
                if number in self._active:
                    self._end(number)
            self._check_holds()
            for number in beginning:
                self._begin(number)
                if number in ending:
                    self._end(number)
                    self._check_holds()
        return check_goal_reached(goal, self._state)

    def _check_times(self, number: int, timed: TimedStep) -> None:
        with _blaming(number, timed.step):
            if timed.step.skill not in self._library.skills:
                raise PlanError("there is no such skill")
            if timed.start_s < -INSTANT_S:
                raise PlanError("it begins before the plan does")

    def _begin(self, number: int) -> None:
        step, library, state = self._steps[number - 1].step, self._library, self._state
        with _blaming(number, step):
            implementations = find_startable_implementations(step, library, state)
            expected_s = float(compute_step_duration_s(step, library, state, self._before))
            if abs(self._steps[number - 1].duration_s - expected_s) > INSTANT_S:
                raise PlanError(f"it takes {expected_s:g} s, not {self._steps[number - 1].duration_s:g}")
            touched = touched_by(step, library, self._locked, state, apply_effects(step, library, state))
            for other, active in self._active.items():
                shared = active.touched.shares_with(touched)
                if shared is not None:
                    raise PlanError(f"it runs beside step {other}, {active.step.skill}: {shared}")
                if touched.is_disturbed_by(active.touched):
                    raise PlanError(f"it begins while step {other}, {active.step.skill}, changes what it reads")
            self._active[number] = _Active(step, touched, implementations)

    def _end(self, number: int) -> None:
        active = self._active.pop(number)
        with _blaming(number, active.step):
            self._state = apply_effects(active.step, self._library, self._state)

    def _check_holds(self) -> None:
        for number, active in self._active.items():
            with _blaming(number, active.step):
                held = filter_held_implementations(active.step, active.implementations, self._library, self._state)
                self._active[number] = replace(active, implementations=held)


@contextmanager
def _blaming(number: int, step: Step) -> Iterator[None]:
    try:
        yield
    except (PlanError, EvaluationError, WorldError) as reason:
        raise PlanError(f"step {number}, {step.skill}: {reason}") from reason


def _by_instant(times_s: Iterable[float]) -> dict[int, list[int]]:
    """Return the numbers of times, from 1, by the time in instants."""
    found: dict[int, list[int]] = {}
    for number, time_s in enumerate(times_s, 1):
        found.setdefault(round(time_s / INSTANT_S), []).append(number)
    return found
