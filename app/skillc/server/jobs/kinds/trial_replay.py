"""Trials that are run again and recorded, so that they can be looked at."""

from __future__ import annotations

from functools import partial
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING

from skillc.contract.job import RunResult
from skillc.contract.trials import TrialReplayRequest, TrialsRequest
from skillc.server.asking import take_snapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.kind import JobKind, PreparedJob
from skillc.server.jobs.kinds.trials import make_runner
from skillc.server.jobs.running import SIMULATION_S, RunningJob
from skillc.server.problems import ApiRefusal
from skillc_runtime.evaluation.report.result import TaskResult

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot


async def _prepare(call: ApiCall, request: TrialReplayRequest) -> PreparedJob:
    trials, seed = call.server.jobs.find(request.trials), request.seed
    wanted = trials.request
    if not isinstance(wanted, TrialsRequest):
        raise ApiRefusal(HTTPStatus.CONFLICT, f"{trials.id} has no trials")
    if seed not in range(wanted.seed, wanted.seed + wanted.number):
        raise ApiRefusal(HTTPStatus.CONFLICT, f"{trials.id} has no trial with the seed {seed}")
    scene = call.server.find_cell(trials.cell).settings.scene

    async def run(job: RunningJob) -> RunResult:
        work = partial(record_trial, wanted, scene, seed, job.folder)
        return RunResult(await job.answer(work, TaskResult, SIMULATION_S))

    return PreparedJob(trials.cell, await take_snapshot(call, trials.cell), run)


def record_trial(request: TrialsRequest, scene: str, seed: int, folder: Path, known: CellSnapshot) -> TaskResult:
    """Return the result of a trial that is run again and recorded in a folder; ServiceError if it cannot be."""
    from skillc.services.project.project import DEFAULT_BACKEND
    from skillc.services.trials.recordings import record_in
    from skillc_runtime.recording.run_spec import RunSpec

    spec = RunSpec(task=request.task, arguments=request.arguments, scene=scene, seed=seed, backend=DEFAULT_BACKEND)
    return record_in(folder, make_runner(request, scene, known), known.library, spec)[0]


KIND = JobKind(TrialReplayRequest, _prepare, "simulations")
