"""Runs trials of a task from the scene of a cell, as `skillc trials` does."""

from __future__ import annotations

from pathlib import Path

import msgspec

from skillc.cells.snapshot import CellSnapshot
from skillc.services.assignments import assign_task
from skillc.services.libraries import find_task
from skillc.services.library_files import find_scene
from skillc.services.reporting import SilentReporter
from skillc.services.stores import load_world
from skillc.services.trial_runs import make_experiment
from skillc.workers.jobs import CheckTrials, RunTrial
from skillc_runtime.evaluation.trials.experiment import TrialRunner
from skillc_runtime.evaluation.trials.trial import Trial

_prepared: dict[bytes, TrialRunner] = {}
"""What was loaded and planned last."""


def check_trials(job: CheckTrials, known: CellSnapshot) -> None:
    """Raise RequestError, DiagnosticsError or ServiceError for trials that cannot be run."""
    library, request = known.library, job.request
    state = load_world(find_scene(Path(job.scene)), library.vocabulary, SilentReporter())
    assign_task(find_task(library, request.task), library, state, request.arguments)


def run_trial(job: RunTrial, known: CellSnapshot) -> Trial | None:
    """Return the trial of a seed, None for none; what was loaded and planned is kept for the next ones.

    Errors as of `check_trials`.
    """
    key = msgspec.json.encode((known.library.hash, job.scene, job.request))
    if key not in _prepared:
        _prepared.clear()
        _prepared[key] = _prepare(job, known)
    return None if job.seed is None else _prepared[key].run(job.seed)


def _prepare(job: RunTrial, known: CellSnapshot) -> TrialRunner:
    library, request, scene = known.library, job.request, find_scene(Path(job.scene))
    state = load_world(scene, library.vocabulary, SilentReporter())
    task = find_task(library, request.task)
    return TrialRunner(make_experiment(task, library, scene, state, request.arguments, request.disturb))
