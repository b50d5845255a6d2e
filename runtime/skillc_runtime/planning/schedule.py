"""Plans with times: which step begins when, several of them at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.plan import GaveUp, LeftOut, Plan, Solved, Step


@dataclass(frozen=True, slots=True)
class TimedStep:
    """A step that begins so many seconds after the plan does, and is expected to last for some."""

    step: Step
    start_s: float
    duration_s: float

    @property
    def end_s(self) -> float:
        """When it is expected to be over, in seconds after the plan begins."""
        return self.start_s + self.duration_s


@dataclass(frozen=True, slots=True)
class Schedule:
    """Steps in the order in which they begin."""

    steps: tuple[TimedStep, ...]

    @property
    def makespan_s(self) -> float:
        """How long after its begin all of it is over, in seconds."""
        return max((each.end_s for each in self.steps), default=0.0)


@dataclass(frozen=True, slots=True)
class Scheduled:
    """A schedule that was played in the world model; `proven` when no plan is over earlier.

    `plan` has the same steps in an order in which they also work one after the other; its duration is all their work.
    `planner` is who found the plan, `times` says where the times come from. Any plan takes `at_least_s`, where that is
    known and less than proven; `assumptions` say which durations are estimates. `note` says what else was tried,
    or would have been.
    """

    schedule: Schedule
    plan: Plan
    optimal: Literal["proven", "best found"]
    planner: str
    times: str
    at_least_s: float | None = None
    note: str | None = None
    left_out: tuple[LeftOut, ...] = ()
    assumptions: tuple[str, ...] = ()

    def as_solved(self) -> Solved:
        """Return it as a plan that takes as long as the schedule."""
        plan = Plan(self.plan.steps, self.schedule.makespan_s)
        return Solved(plan, self.optimal, self.planner, self.left_out, self.at_least_s, self.assumptions)


class Scheduler(Protocol):
    """Something that finds plans with times, which are over early."""

    @property
    def name(self) -> str:
        """What users know it by."""
        ...

    def schedule(self, problem: Problem, deadline_s: float) -> Schedule | GaveUp:
        """Return a schedule within so many seconds of wall-clock time; never raises for what the problem or time is."""
        ...
