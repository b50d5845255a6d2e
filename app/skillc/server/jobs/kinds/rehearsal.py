"""Rehearsals: what an operation does in a simulated twin of a cell, as the cell knows itself now."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from skillc.contract.job import RunResult
from skillc.contract.messages import TakeSnapshot
from skillc.contract.rehearsal import RehearsalRequest
from skillc.server.asking import ask_with, take_snapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.kind import CHECK_S, JobKind, PreparedJob
from skillc.server.jobs.running import SIMULATION_S, RunningJob
from skillc.workers.questions import check_operation
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.recording.commands import AnswerPrompt, Command, Stop

WHO = "the rehearsal"
"""Who has answered, as it is recorded."""

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot
    from skillc_runtime.devices.prompts import Prompt
    from skillc_runtime.execution.pace import Pace
    from skillc_runtime.execution.task_run import TaskRun
    from skillc_runtime.recording.events import Event


async def _prepare(call: ApiCall, request: RehearsalRequest) -> PreparedJob:
    cell = call.server.find_cell(request.cell).settings.name
    twin = await take_snapshot(call, cell, TakeSnapshot(beside="devices"))
    await ask_with(call, partial(check_operation, request, ()), twin, type(None), CHECK_S)

    async def run(job: RunningJob) -> RunResult:
        return RunResult(await job.answer(partial(rehearse, request, job.folder), TaskResult, SIMULATION_S))

    return PreparedJob(cell, twin, run)


def rehearse(request: RehearsalRequest, folder: Path, known: CellSnapshot) -> TaskResult:
    """Return the result of an operation in a twin; ServiceError if it cannot be one, or nothing can be written."""
    from skillc.cells.operations.assigning import assign_request
    from skillc.services.reporting.reporter import SilentReporter
    from skillc.services.run.running import RunOptions, run_task
    from skillc.services.tasks.loading import LoadedTask
    from skillc_runtime.execution.pace import Pace
    from skillc_runtime.recording.run_spec import RunSpec
    from skillc_runtime.world.state.model import WorldModel

    assignment = assign_request(request.task, request.goal, request.call, request.arguments, known.library, known.state)
    options = RunOptions(
        RunSpec(
            task=request.task,
            arguments=request.arguments,
            goal=request.goal,
            call=request.call,
            seed=request.seed,
            deadline_s=request.deadline_s,
            geometry=request.geometry,
            backend=known.backend,
            out=str(folder) if request.film else None,
        ),
        record_in=folder if request.record else None,
        tick_timeout_s=None,
        saved=known.devices or None,
    )
    loaded = LoadedTask(known.library, assignment, WorldModel(known.state))
    return run_task(loaded, options, Unattended(Pace(), request.answers), SilentReporter()).result


@dataclass(slots=True)
class Unattended:
    """A run that nobody watches, as fast as it computes; what it asks is answered at once, or it is stopped.

    An answer is the first of `answers` that is a choice, otherwise the default of the question.
    """

    pace: Pace
    answers: Sequence[str] = ()

    def __call__(self, event: Event) -> None:
        """Do nothing."""

    def say(self, message: str) -> None:
        """Do nothing."""

    def operating(self) -> AbstractContextManager[None]:
        """Return a context that does nothing."""
        return nullcontext()

    def attend(self, run: TaskRun, now: float, seconds: float) -> Sequence[Command]:
        """Return what answers the questions of a run."""
        return [self._answer(each) for each in run.prompts] if run.state == "running" else ()

    def _answer(self, prompt: Prompt) -> Command:
        choice = next((each for each in self.answers if each in prompt.choices), prompt.default)
        if choice:
            return AnswerPrompt(choice, prompt.id, who=WHO)
        choices = ", ".join(f'"{each}"' for each in prompt.choices)
        return Stop(f'it asks "{prompt.text}", and a rehearsal has no answer: give one of its choices, {choices}')


KIND = JobKind(RehearsalRequest, _prepare, "simulations")
