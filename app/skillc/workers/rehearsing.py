"""Rehearses an operation: does it in a simulated twin of the cell, as the cell knows itself now."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path

from skillc.cells.operations.assigning import assign_request
from skillc.cells.snapshot import CellSnapshot
from skillc.contract.jobs import Rehearse
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.model import WorldModel


def rehearse(job: Rehearse, known: CellSnapshot) -> TaskResult:
    """Return the result of an operation in a twin; ServiceError if it cannot be one, or nothing can be written."""
    wanted, world = job.request, WorldModel(known.state)
    assignment = assign_request(wanted.task, wanted.goal, wanted.call, wanted.arguments, known.library, known.state)
    options = RunOptions(
        RunSpec(
            task=wanted.task,
            arguments=wanted.arguments,
            goal=wanted.goal,
            call=wanted.call,
            seed=wanted.seed,
            deadline_s=wanted.deadline_s,
            geometry=wanted.geometry,
            backend=known.backend,
            out=job.folder if wanted.film else None,
        ),
        record_in=Path(job.folder) if wanted.record else None,
        tick_timeout_s=None,
        saved=known.devices or None,
    )
    return run_task(LoadedTask(known.library, assignment, world), options, _Unattended(), SilentReporter()).result


@dataclass(slots=True)
class _Unattended:
    """A run that nobody watches, as fast as it computes."""

    pace: Pace = field(default_factory=Pace)

    def __call__(self, event: Event) -> None:
        """Do nothing."""

    def say(self, message: str) -> None:
        """Do nothing."""

    def operating(self) -> AbstractContextManager[None]:
        """Return a context that does nothing."""
        return nullcontext()

    def attend(self, run: TaskRun, now: float, seconds: float) -> Sequence[Command]:
        """Return no commands."""
        return ()
