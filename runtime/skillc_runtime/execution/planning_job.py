"""Planning beside a loop that must not wait for it: in a process that can be killed."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import msgspec

from skillc_model.skills import SkillLibrary
from skillc_model.tree import Node
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import Assignment, NotStarted, PlannedSteps, PreparedTask
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.execution.refinement.run_planning import LOOK_S, SpaceLook
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.worker_process import ReportingFunction, Returned, WorkerProcess, WorkerResult
from skillc_runtime.planning.arrangement import arrange_followed
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.objectives.always import find_broken_at_start
from skillc_runtime.planning.progress import PlanningProgress, ReportProgress
from skillc_runtime.planning.schedule import DEADLINE_S, Planners
from skillc_runtime.planning.validation import PlanError, check_goal_reached, follow_plan, validate
from skillc_runtime.platforms.processes import DEFAULT_START, StartMethod
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.world_state import WorldState

GRACE_S = 2.0
"""How long after its deadline a worker may take to answer that it found no plan in time, before it is killed."""
POLL_S = 0.05
"""The interval at which a wait looks whether planning was cancelled."""

Preparation: TypeAlias = PreparedTask | NotStarted


class PlanningJob:
    """The planning of one assignment in a worker process: to be polled until there is an answer, or killed.

    The answer equals that of `replan_task` in this process. If the worker dies, or does not end in time, the answer is
    `NotStarted` with the reason. At the end of a `with` statement the worker is killed if it still runs.
    """

    waits_for = ""

    def __init__(
        self,
        assignment: Assignment,
        library: SkillLibrary,
        failures: FailedSteps | None = None,
        find_planners: Callable[[], Planners] | None = None,
        cancel: CancelToken | None = None,
        deadline_s: float = DEADLINE_S,
        start: StartMethod = DEFAULT_START,
        look: SpaceLook | None = None,
    ) -> None:
        """Start planning without the steps in `failures`, for up to `deadline_s` or until it is cancelled.

        The worker uses what `find_planners` returns, by default what is installed: planners are slow to import.
        With a `look` each plan is looked at in space, which may take until then, or LOOK_S longer than the planners.
        OSError if no process can be started.
        """
        self._assignment, self._cancel = assignment, cancel or CancelToken()
        self._answer: Preparation | None = None
        self._deadline = CancelToken(deadline_s + GRACE_S + (0.0 if look is None else LOOK_S))
        task = _PlanningTask(
            assignment, library, failures or FailedSteps(library), find_planners, self._cancel.limited(deadline_s), look
        )
        self._worker = WorkerProcess(ReportingFunction(task), start)
        self._worker.ask(None)

    @property
    def progress(self) -> PlanningProgress | None:
        """How far the planner is, as it has reported last; None before that and after its answer."""
        return self._worker.report if self._answer is None else None

    def __enter__(self) -> PlanningJob:
        return self

    def __exit__(self, *_: object) -> None:
        self.kill()

    def poll(self) -> Preparation | None:
        """Return the answer if there is one, else None; it never waits, unless a worker has to be ended now."""
        return self.wait(0.0)

    def wait(self, seconds: float) -> Preparation | None:
        """Wait for the answer for up to `seconds`; None if there is none yet."""
        end = CancelToken(seconds)
        self._look(0.0)
        while self._answer is None and end.remaining_s > 0.0:
            self._look(min(end.remaining_s, POLL_S))
        return self._answer

    def kill(self, why: str = "it was cancelled") -> None:
        """End the worker and the planners that it runs within a few seconds, if there is no answer yet."""
        if self._answer is None:
            self._worker.kill()
            self._answer = NotStarted(f"planning was stopped: {why}")

    def _look(self, seconds: float) -> None:
        """Wait for up to `seconds` for a result; end the worker if it may not go on."""
        if self._answer is None and (result := self._worker.wait(seconds)) is not None:
            self._answer = self._interpret(result)
            self._worker.kill()
        elif (why := self._cancel.reason or self._deadline.reason) is not None:
            self.kill(why)

    def _interpret(self, result: WorkerResult) -> Preparation:
        if not isinstance(result, Returned):
            return NotStarted(f"planning failed: {result.why}")
        if isinstance(result.value, NotStarted):
            return result.value
        planned: _Planned = result.value
        return PreparedTask(self._assignment, planned.body, planned.steps, planned.space)


def find_arrival_problem(prepared: PreparedTask, library: SkillLibrary, now: WorldState) -> str | None:
    """Return why a body that was prepared for an earlier version of the world cannot run in `now`; None if it can.

    The steps of a plan must still be possible, lead to the goal, and depend on each other as they did.
    """
    goal, planned = prepared.assignment.plan_goal(library), prepared.planned
    broken = find_broken_at_start(prepared.assignment.always, now)
    if broken is not None:
        return broken
    if planned is not None and goal is not None and now is not prepared.assignment.state:
        plan = planned.solved.plan
        try:
            foreseen, state = foresee(prepared.assignment.plan_library(library), now, goal)
            worlds = follow_plan(plan, foreseen, state)
            if plan.branches:
                validate(plan, foreseen, state, goal)
            else:
                check_goal_reached(goal, worlds[-1])
            arrangement = arrange_followed(plan, foreseen, worlds)
        except PlanError as reason:
            return str(reason)
        if build_plan_body(plan, arrangement, library, prepared.space) != prepared.body:
            return "its steps now depend on each other in another way"
    return "\n".join(map(str, preflight(prepared.body, library, now))) or None


class _Planned(msgspec.Struct, frozen=True):
    """A prepared task without its assignment, which the parent has."""

    body: Node
    steps: PlannedSteps | None
    space: SpaceClaim | None


class _PlanningTask(msgspec.Struct, frozen=True):
    """What the worker does."""

    assignment: Assignment
    library: SkillLibrary
    failures: FailedSteps
    find_planners: Callable[[], Planners] | None
    cancel: CancelToken
    look: SpaceLook | None

    def __call__(self, _request: None, report: ReportProgress) -> _Planned | NotStarted:
        # What plans is slow to import, and only the worker needs it.
        from skillc_runtime.execution.task_planning import replan_task

        planners = None if self.find_planners is None else self.find_planners()
        answer = replan_task(self.assignment, self.library, self.failures, planners, self.cancel, report, self.look)
        return answer if isinstance(answer, NotStarted) else _Planned(answer.body, answer.planned, answer.space)
