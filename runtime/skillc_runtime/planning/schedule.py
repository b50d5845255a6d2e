"""Plans with times: steps that may run in parallel."""

from __future__ import annotations

from typing import Literal, Protocol, TypeAlias

import msgspec
from msgspec.structs import replace

from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import GaveUp, LeftOut, Plan, Planner, PlanResult, Solved, Step
from skillc_runtime.planning.progress import ReportProgress, ignore_progress

DEADLINE_S = 30.0
"""How long planners search unless something else is asked for, in s of wall time."""


class TimedStep(msgspec.Struct, frozen=True):
    """A step, its start in s after the start of the plan, and its expected duration in s."""

    step: Step
    start_s: float
    duration_s: float

    @property
    def end_s(self) -> float:
        """The expected end, in s after the start of the plan."""
        return self.start_s + self.duration_s


class Schedule(msgspec.Struct, frozen=True):
    """Steps in the order in which they start."""

    steps: tuple[TimedStep, ...]

    @property
    def makespan_s(self) -> float:
        """The time from the start of the plan to the end of the last step, in s."""
        return max((each.end_s for each in self.steps), default=0.0)


class Scheduled(msgspec.Struct, frozen=True):
    """A schedule that was simulated in the world model; "proven" if no plan has a shorter makespan.

    `plan` has the same steps in an order that works sequentially; its duration is the sum of theirs. `planner` is the
    name of the planner that found the plan, `times` describes where the times come from. `at_least_s` is a lower bound
    in s on the makespan of any plan; None if none is known or the schedule is proven to be optimal. `assumptions`
    describe which durations are estimates, `note` what else was tried.
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
        """Return it as a plan whose duration is the makespan of the schedule."""
        plan = replace(self.plan, duration_s=self.schedule.makespan_s)
        return Solved(plan, self.optimal, self.planner, self.left_out, self.at_least_s, self.assumptions)


class FoundSchedule(msgspec.Struct, frozen=True):
    """A schedule that nothing has validated yet; no plan of the problem has a makespan below `at_least_s`, in s."""

    schedule: Schedule
    at_least_s: float


PlanAnswer: TypeAlias = PlanResult | Scheduled
"""What came of planning, with or without times."""


class Scheduler(Protocol):
    """Finds plans with a short makespan."""

    @property
    def name(self) -> str:
        """The name that is shown to users."""
        ...

    def schedule(
        self,
        problem: Problem,
        first: Schedule | None,
        cancel: CancelToken,
        report: ReportProgress = ignore_progress,
    ) -> FoundSchedule | GaveUp:
        """Return a schedule before `cancel` ends the search, and `report` how far it is while that goes on.

        The search goes on from the `first` schedule, if there is one. All failures are answers, not exceptions.
        """
        ...


class Planners(msgspec.Struct, frozen=True):
    """The planners that minimise work, the strongest first, and the scheduler that minimises the makespan, if any."""

    for_work: tuple[Planner, ...]
    for_makespan: Scheduler | None
