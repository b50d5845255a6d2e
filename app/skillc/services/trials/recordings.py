"""Records trials as MCAP files, as runs are."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from skillc.errors import ServiceError
from skillc.services.project.project import DEFAULT_BACKEND
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.recordings import KnownStart, describe_contents, recorded_in
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.trials.disturbance import TrialCell
from skillc_runtime.evaluation.trials.experiment import NotRecorded, TrialRunner
from skillc_runtime.evaluation.trials.settings import Setting, apply_settings
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.recording.envelope import make_run_id
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError


def record_in(
    folder: Path, runner: TrialRunner, library: SkillLibrary, spec: RunSpec, *settings: Setting
) -> tuple[TaskResult, Trial]:
    """Return a trial that is run with settings and recorded in a folder; `spec` has its task, scene, seed, back end.

    ServiceError if it does not start, or the folder cannot be written to.
    """
    recording = partial(_recording, folder, apply_settings(library, settings), spec)
    try:
        return runner.record(spec.seed, recording, *settings)
    except (NotRecorded, SheetError, FrameError) as error:
        raise ServiceError(f"this trial does not start: {error}") from error


@contextmanager
def _recording(folder: Path, library: SkillLibrary, spec: RunSpec, cell: TrialCell) -> Iterator[tuple[Listener, ...]]:
    """Record a trial as an MCAP file; yields who gets the events."""
    task, scene = spec.task or "", spec.scene or ""
    run, origin = make_run_id(task), CellOrigin(scene, spec.seed, spec.backend or DEFAULT_BACKEND)
    describe = partial(describe_contents, run, task, library, KnownStart(cell.world.snapshot()), origin, spec)
    with recorded_in(folder, describe, cell, SilentReporter()) as recorders:
        yield (Publisher(run, recorders),)
