"""Runs trials of a task from the scene of a cell, as `skillc trials` does."""

from __future__ import annotations

from pathlib import Path

import msgspec

from skillc.cells.snapshot import CellSnapshot
from skillc.contract.jobs import CheckTrials, RecordTrial, RunTrial
from skillc.services.library.files import find_scene
from skillc.services.project.backends import DEFAULT_BACKEND
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import load_world
from skillc.services.tasks.assignments import assign_task
from skillc.services.tasks.listing import find_task
from skillc.services.trials.recordings import record_in
from skillc.services.trials.running import bind_trial_task, require_effect
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.trials.experiment import TrialRunner
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.recording.run_spec import RunSpec

_prepared: dict[bytes, TrialRunner] = {}
"""What was loaded and planned last."""


def check_trials(job: CheckTrials, known: CellSnapshot) -> None:
    """Raise RequestError, DiagnosticsError or ServiceError for trials that cannot be run."""
    library, request = known.library, job.request
    state = load_world(find_scene(Path(job.scene)), library.vocabulary, SilentReporter())
    assign_task(find_task(library, request.task), library, state, request.arguments)
    require_effect(request.disturb, state)


def run_trial(job: RunTrial, known: CellSnapshot) -> Trial | None:
    """Return the trial of a seed, None for none; what was loaded and planned is kept for the next ones.

    Errors as of `check_trials`.
    """
    key = msgspec.json.encode((known.library.hash, job.scene, job.request))
    if key not in _prepared:
        _prepared.clear()
        _prepared[key] = _prepare(job, known)
    return None if job.seed is None else _prepared[key].run(job.seed)


def record_trial(job: RecordTrial, known: CellSnapshot) -> TaskResult:
    """Return the result of a trial that is run again and recorded; ServiceError if it cannot be."""
    spec = RunSpec(
        task=job.request.task,
        arguments=job.request.arguments,
        scene=job.scene,
        seed=job.seed,
        backend=DEFAULT_BACKEND,
    )
    return record_in(Path(job.folder), _prepare(job, known), known.library, spec)[0]


def _prepare(job: RunTrial | RecordTrial, known: CellSnapshot) -> TrialRunner:
    library, request, scene = known.library, job.request, find_scene(Path(job.scene))
    state = load_world(scene, library.vocabulary, SilentReporter())
    library, task = bind_trial_task(find_task(library, request.task), library, state, request.arguments)
    return TrialRunner(library, state, task, request.disturb)
