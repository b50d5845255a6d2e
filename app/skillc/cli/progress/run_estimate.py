"""How far a run is along its plan, and how long it may still take."""

from __future__ import annotations

import msgspec

from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted, PlanMade, Replanned
from skillc_runtime.recording.failure_text import describe_failure

LEAST_WALL_S = 1.0
"""How long a plan is followed before its speed tells how long the rest takes, in s of wall time."""


class EndedStep(msgspec.Struct, frozen=True):
    """A step of a plan that ended at the time `at_s` of the cell in s, and why it failed if it did."""

    skill: str
    status: str
    at_s: float
    reason: str = ""


class Estimate(msgspec.Struct, frozen=True):
    """The `step` of so many `steps` that runs, from 1, the `share` of the plan that is done, and times in s.

    `total_s` is how long the plan takes in the time of the cell; `left_s` how long the rest takes in wall time, None if
    that is not known yet.
    """

    step: int
    steps: int
    share: float
    total_s: float
    left_s: float | None


class PlanProgress:
    """Counts the steps of the plan that is followed, which are its outermost calls."""

    def __init__(self) -> None:
        self._steps, self._done, self._cost_s = 0, 0, 0.0
        self._began_s, self._began_wall_s = 0.0, 0.0
        self._calls_around: dict[int, int] = {0: 0}
        self._outermost: set[int] = set()

    def observe(self, event: Event, wall_s: float) -> EndedStep | None:
        """Take an event into account, at a wall time in s; return the step that it ends, None for other events."""
        match event:
            case PlanMade(steps=steps, cost=cost, time=now):
                self._steps, self._done, self._cost_s = len(steps), 0, cost
                self._began_s, self._began_wall_s = now, wall_s
            case Replanned():
                self._steps = 0
            case NodeStarted(node=node, parent=parent, kind=kind):
                around = self._calls_around.get(parent, 0)
                self._calls_around[node] = around + (kind == "call")
                if kind == "call" and around == 0:
                    self._outermost.add(node)
            case NodeEnded(node=node, status=status, failure=failure):
                self._calls_around.pop(node, None)
                if node in self._outermost:
                    self._outermost.remove(node)
                    self._done += status == "success"
                    return EndedStep(event.name, status, event.time, describe_failure(failure) if failure else "")
            case _:
                pass
        return None

    def estimate(self, now_s: float, wall_s: float) -> Estimate | None:
        """Return how far the plan is at the time `now_s` of the cell and at a wall time; None without a plan.

        The expected duration of the plan says how far it is within its step, and the speed up to now how long the rest
        takes.
        """
        if not self._steps or self._done >= self._steps:
            return None
        passed_s, wall_passed_s = now_s - self._began_s, wall_s - self._began_wall_s
        expected = passed_s / self._cost_s if self._cost_s > 0.0 else 0.0
        share = min(max(expected, self._done / self._steps), (self._done + 1) / self._steps)
        total_s = self._cost_s if share >= expected else passed_s / share
        known = passed_s > 0.0 and wall_passed_s >= LEAST_WALL_S
        left_s = max(0.0, total_s - passed_s) * wall_passed_s / passed_s if known else None
        return Estimate(self._done + 1, self._steps, share, total_s, left_s)
