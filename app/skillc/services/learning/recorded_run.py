"""Runs the task once with settings, in a process of its own, and records the run."""

from __future__ import annotations

import tempfile
from functools import partial
from pathlib import Path
from typing import assert_never

import msgspec

from skillc.errors import ServiceError
from skillc.services.project.project import DEFAULT_BACKEND
from skillc.services.trials.recordings import record_in
from skillc_model import codec
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.evaluation.trials.content import Experiment, prepare_runner
from skillc_runtime.evaluation.trials.settings import Setting
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess
from skillc_runtime.recording.run_spec import RunSpec


class RunOrder(msgspec.Struct, frozen=True, kw_only=True):
    """What is run: an experiment whose scene is the file `scene`, with settings and the seed of the world."""

    experiment: Experiment
    scene: str
    arguments: dict[str, str]
    seed: int
    settings: tuple[Setting, ...] = ()


def record_run(order: RunOrder, folder: Path, limit_s: float) -> Trial:
    """Return the trial of a run that is recorded in a folder.

    ServiceError if it does not start, takes longer than `limit_s` of wall time, or its process dies.
    """
    process = WorkerProcess(partial(_record, order))
    try:
        result = process.answer(folder, CancelToken(limit_s))
    finally:
        process.kill()
    match result:
        case Returned(Trial() as trial):
            return trial
        case Returned(problem):
            raise ServiceError(str(problem))
        case Raised(why) | Died(why):
            raise ServiceError(f"the task cannot be run: {why}")
        case None:
            raise ServiceError(f"the task has not ended after {limit_s:g} s")
        case _:
            assert_never(result)


def _record(order: RunOrder, folder: Path) -> Trial | str:
    """Return the trial, or why it does not start."""
    spec = RunSpec(
        task=order.experiment.task,
        arguments=order.arguments,
        scene=order.scene,
        seed=order.seed,
        reality=order.experiment.reality,
        backend=DEFAULT_BACKEND,
    )
    library = codec.loads(order.experiment.library, "the library")
    with tempfile.TemporaryDirectory(prefix="skillc-learn-") as place:
        tempfile.tempdir = place
        try:
            return record_in(folder, prepare_runner(order.experiment), library, spec, *order.settings)[1]
        except ServiceError as error:
            return str(error)
