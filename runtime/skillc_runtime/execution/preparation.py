"""How a task run gets to its next attempt: a plan made beside the loop that still works, and free devices."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

import msgspec
from msgspec.structs import replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import Assignment, NotStarted, PreparedTask
from skillc_runtime.execution.device_claims import DeviceClaims, DevicesBusy, find_claim
from skillc_runtime.execution.planning_job import find_arrival_problem
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.planning.progress import PlanningProgress
from skillc_runtime.world.state.world_state import WorldState


class Preparation(Protocol):
    """The planning of an assignment beside the loop, with all checks before anything moves."""

    @property
    def waits_for(self) -> str:
        """For what it waits before it begins; empty once it goes on."""
        ...

    @property
    def progress(self) -> PlanningProgress | None:
        """How far its planner is; None if that is not known."""
        ...

    def poll(self) -> PreparedTask | NotStarted | None:
        """Return the answer, None if there is none yet; never waits."""
        ...

    def wait(self, seconds: float) -> PreparedTask | NotStarted | None:
        """Wait for the answer for up to `seconds` of wall time."""
        ...

    def kill(self) -> None:
        """End the planning within a few seconds."""
        ...


StartPreparation: TypeAlias = Callable[[Assignment, FailedSteps], Preparation]
"""Starts to plan an assignment without the steps that failed."""


class Ready(msgspec.Struct, frozen=True):
    """The preparation of a task that is prepared already."""

    answer: PreparedTask | NotStarted
    waits_for: str = ""
    progress: PlanningProgress | None = None

    def poll(self) -> PreparedTask | NotStarted:
        """Return the answer."""
        return self.answer

    def wait(self, seconds: float) -> PreparedTask | NotStarted:
        """Return the answer."""
        return self.answer

    def kill(self) -> None:
        """Do nothing."""


def prepare_here(library: SkillLibrary, find_look: Callable[[], SpaceLook] | None = None) -> StartPreparation:
    """Return what plans in this process while everything else waits: for a process that itself can be killed.

    Plans are looked at in space as `find_look` says when they are made; without it they are not.
    """
    # What plans is slow to import, and runs plan in other processes.
    from skillc_runtime.execution.task_planning import replan_task

    def prepare(assignment: Assignment, failures: FailedSteps) -> Ready:
        return Ready(replan_task(assignment, library, failures, look=None if find_look is None else find_look()))

    return prepare


def prepare_after(prepared: PreparedTask, start: StartPreparation) -> StartPreparation:
    """Return what answers with a prepared task first, and then does as `start`."""
    first = [prepared]
    return lambda assignment, failures: Ready(first.pop()) if first else start(assignment, failures)


class Outdated(msgspec.Struct, frozen=True):
    """The world has changed since a task was prepared, so that it cannot run, for the `times`th time."""

    problem: str
    times: int


class NextAttempt:
    """The way to the next attempt: a preparation that goes on, or a prepared task that waits to begin."""

    def __init__(self, start: StartPreparation) -> None:
        self.preparation: Preparation | None = None
        self.prepared: PreparedTask | None = None
        self._start, self._outdated = start, 0

    def plan(self, assignment: Assignment, failures: FailedSteps) -> None:
        """Start to plan."""
        self.prepared, self.preparation = None, self._start(assignment, failures)

    @property
    def waits_for(self) -> str:
        """For what the preparation waits before it begins; empty if for nothing."""
        return self.preparation.waits_for if self.preparation is not None else ""

    @property
    def progress(self) -> PlanningProgress | None:
        """How far the planner of the preparation is; None if none goes on, or that is not known."""
        return self.preparation.progress if self.preparation is not None else None

    def wait(self, seconds: float) -> None:
        """Wait for up to `seconds` of wall time for the answer of the preparation, if one goes on."""
        if self.preparation is not None:
            self.preparation.wait(seconds)

    def take(self) -> PreparedTask | NotStarted | None:
        """Return the answer of the preparation if it has arrived; a prepared task then waits to begin."""
        answer = self.preparation.poll() if self.preparation is not None else None
        if answer is not None:
            self.preparation = None
        if isinstance(answer, PreparedTask):
            self.prepared = answer
        return answer

    def begin(
        self, run: str, claims: DeviceClaims, library: SkillLibrary, state: WorldState
    ) -> PreparedTask | DevicesBusy | Outdated:
        """Return the prepared task if it works in `state`, the present one, and its devices are free: `run` has them.

        It still waits if devices are busy, and then the run holds none, so that no two wait for each other; it is
        discarded if it does not work any more.
        """
        prepared = self.prepared
        assert prepared is not None, "nothing is prepared"
        if state is not prepared.assignment.state:
            problem = find_arrival_problem(prepared, library, state)
            if problem is not None:
                claims.withdraw(run)
                self.prepared, self._outdated = None, self._outdated + 1
                return Outdated(problem, self._outdated)
            self.prepared = prepared = replace(prepared, assignment=replace(prepared.assignment, state=state))
        busy = claims.wait_for(run, find_claim(prepared.body, library, state))
        if busy is not None:
            return busy
        self.prepared = None
        return prepared

    def discard(self) -> None:
        """End the preparation, or forget the prepared task."""
        if self.preparation is not None:
            self.preparation.kill()
        self.preparation = self.prepared = None
