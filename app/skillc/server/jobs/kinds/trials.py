"""Trials: a task is run many times from the scene of a cell, one trial after the other, as `skillc trials` does.

Each trial that is done is kept: trials that are begun again go on with those that are missing.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from skillc.contract.job import Job, TrialsResult
from skillc.contract.trials import TrialsRequest
from skillc.server.asking import ask_with, take_snapshot
from skillc.server.http.api_call import ApiCall
from skillc.server.jobs.kind import CHECK_S, JobKind, PreparedJob
from skillc.server.jobs.running import RunningJob
from skillc.workers.pool import WorkCrashed, WorkTimedOut
from skillc_runtime.evaluation.trials.judging import judge_series
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.evaluation.trials.verdict import find_unmet_criteria

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot
    from skillc_runtime.evaluation.trials.experiment import TrialRunner

PREPARATION_S = 600.0
"""How long loading and planning may take, in s."""

_prepared: dict[bytes, TrialRunner] = {}
"""What this process, a worker, has loaded and planned last."""


async def _prepare(call: ApiCall, request: TrialsRequest) -> PreparedJob:
    cell = call.server.find_cell(request.cell).settings
    known = await take_snapshot(call, cell.name)
    await ask_with(call, partial(check_trials, request, cell.scene), known, type(None), CHECK_S)
    return PreparedJob(cell.name, known, partial(_run, request, cell.scene), request.number)


async def _run(request: TrialsRequest, scene: str, job: RunningJob) -> None:
    """Run all trials that are not done; errors of what keeps the task from being run at all."""
    done = {msgspec.json.decode(each, type=Trial).seed for each in job.parts}
    prepared = False
    for seed in range(request.seed, request.seed + request.number):
        if seed in done:
            continue
        if not prepared:
            await job.answer(partial(run_trial, request, scene, None), type(None), PREPARATION_S)
            prepared = True
        try:
            trial = await job.answer(partial(run_trial, request, scene, seed), Trial, request.deadline_s)
        except WorkCrashed as error:
            trial, prepared = Trial(seed=seed, status="crashed", reason=str(error)), False
        except WorkTimedOut:
            why = f"it took longer than {request.deadline_s:g} s"
            trial, prepared = Trial(seed=seed, status="crashed", reason=why), False
        why_not = find_unmet_criteria(trial, request.disturb)
        job.add_part(msgspec.json.encode(trial), f"seed {seed}: {'; '.join(why_not) or 'passed'}", not why_not)


def _judge(job: Job, parts: Sequence[bytes]) -> TrialsResult:
    from skillc.services.tasks.assignments import write_call

    request = job.request
    assert isinstance(request, TrialsRequest), "these are the requests of this kind"
    task = write_call(request.task, request.arguments) if request.arguments else request.task
    trials = [msgspec.json.decode(each, type=Trial) for each in parts]
    return TrialsResult(judge_series(task, request.disturb, request.number, trials))


def check_trials(request: TrialsRequest, scene: str, known: CellSnapshot) -> None:
    """Raise RequestError, DiagnosticsError or ServiceError for trials that cannot be run from the file of a scene."""
    from skillc.services.library.files import find_scene
    from skillc.services.reporting.reporter import SilentReporter
    from skillc.services.scene.stores import load_world
    from skillc.services.tasks.assignments import assign_task
    from skillc.services.tasks.listing import find_task
    from skillc.services.trials.running import require_effect

    library = known.library
    state = load_world(find_scene(Path(scene)), library.vocabulary, SilentReporter())
    assign_task(find_task(library, request.task), library, state, request.arguments)
    require_effect(request.disturb, state)


def run_trial(request: TrialsRequest, scene: str, seed: int | None, known: CellSnapshot) -> Trial | None:
    """Return the trial of a seed, None for none; what was loaded and planned is kept for the next ones.

    Errors as of `check_trials`.
    """
    key = msgspec.json.encode((known.library.hash, scene, request))
    if key not in _prepared:
        _prepared.clear()
        _prepared[key] = make_runner(request, scene, known)
    return None if seed is None else _prepared[key].run(seed)


def make_runner(request: TrialsRequest, scene: str, known: CellSnapshot) -> TrialRunner:
    """Return what runs trials from the file of a scene; errors as of `check_trials`."""
    from skillc.services.library.files import find_scene
    from skillc.services.reporting.reporter import SilentReporter
    from skillc.services.scene.stores import load_world
    from skillc.services.tasks.listing import find_task
    from skillc.services.trials.running import bind_trial_task
    from skillc_runtime.evaluation.trials.experiment import TrialRunner

    library = known.library
    state = load_world(find_scene(Path(scene)), library.vocabulary, SilentReporter())
    library, task = bind_trial_task(find_task(library, request.task), library, state, request.arguments)
    return TrialRunner(library, state, task, request.disturb)


KIND = JobKind(TrialsRequest, _prepare, "trials", summarise=_judge)
