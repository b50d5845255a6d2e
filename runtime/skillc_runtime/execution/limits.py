"""What ends a run early: its deadline, the time that its task states, and what its task says holds always."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from skillc_model.conditions import Condition
from skillc_model.skills import TaskPart
from skillc_runtime.execution.tree.context import EPSILON_S
from skillc_runtime.planning.objectives.always import find_broken
from skillc_runtime.primitives.time_limits import describe_slowness
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.states import State
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent

HELD: frozenset[State] = frozenset({"planned", "paused"})
"""The states in which a run waits for a person; the time in them does not count for its task."""


class TimeLimit:
    """The time of a cell, in s, that a run has left.

    The deadline counts from the submission at `now`. The time of the task, `within_s`, counts from the first step,
    without the states of `HELD`; it does not count if there is a deadline. Of several `parts` with times of their own,
    the goal of each holds when its time is over.
    """

    def __init__(self, within_s: float | None, now: float, parts: Sequence[TaskPart] = ()) -> None:
        self._within_s, self._submitted_at = within_s, now
        self._parts = [(each.within_s, each) for each in parts if each.within_s is not None]
        self._counts_from: float | None = None
        self._counted_s = 0.0
        self._begun = False

    def follow(self, state: State, now: float) -> None:
        """Take over the state of the run since `now`."""
        self._begun = self._begun or state == "running"
        if self._counts_from is not None:
            self._counted_s += now - self._counts_from
        self._counts_from = now if self._begun and state not in HELD else None

    def left_s(self, spec: RunSpec, now: float) -> float:
        """Return for how long it may go on; below 0 if it has taken too long, infinity if nothing limits it."""
        if spec.deadline_s is not None:
            return self._submitted_at + spec.deadline_s + EPSILON_S - now
        limits = [within_s for within_s, _ in self._parts]
        limits += [] if self._within_s is None else [self._within_s]
        return min(limits, default=math.inf) + EPSILON_S - self._counted(now)

    def describe_excess(self, spec: RunSpec, now: float, world: WorldModel) -> str | None:
        """Return how the time was exceeded, as a sentence; None if it was not."""
        if self.left_s(spec, now) >= 0.0:
            return None
        slow = describe_slowness(spec.speed)
        if spec.deadline_s is not None:
            return f"the task exceeded its deadline of {spec.deadline_s:g} s{slow}"
        if self._within_s is not None and self._within_s + EPSILON_S < self._counted(now):
            return f"the task was not done within {self._within_s:g} s{slow}"
        over = [part for within_s, part in self._parts if within_s + EPSILON_S < self._counted(now)]
        late = next((part for part in over if not evaluate(part.goal, world.snapshot(), {})), None)
        if late is not None:
            return f"`{late.name}` was not done within {late.within_s:g} s{slow}"
        self._parts = [each for each in self._parts if each[1] not in over]
        return None

    def _counted(self, now: float) -> float:
        return self._counted_s + (0.0 if self._counts_from is None else now - self._counts_from)


class AlwaysWatch:
    """Notes what is broken first, after each change of the world, whoever makes it."""

    def __init__(self, always: Sequence[Condition], world: WorldModel) -> None:
        self._always, self._world = tuple(always), world
        self._stop: Callable[[], None] | None = None
        self.broken: str | None = None
        """What was broken first, and why, as a clause; None as long as all has held."""
        self.by = ""
        """The origin of the write that has broken it; empty if it was broken at the beginning."""

    def begin(self) -> None:
        """Watch from now on, unless that has begun before."""
        if self._always and self._stop is None:
            self.broken = find_broken(self._always, self._world.snapshot())
            self._stop = self._world.subscribe(self._look)

    def end(self) -> None:
        """Watch no more."""
        if self._stop is not None:
            self._stop()
            self._stop = None

    def _look(self, event: ChangeEvent) -> None:
        if self.broken is None:
            self.broken, self.by = find_broken(self._always, event.after), event.origin
