"""The end of a task that never ran, because its scene cannot be simulated or because it was stopped before."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Literal

from skillc.errors import ServiceError
from skillc.services.recording.recordings import NAME
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.recordings import KnownStart, describe_contents, recorded_in
from skillc.services.run.result import ReportedRun
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.execution.run_events import make_start_event
from skillc_runtime.recording.envelope import make_run_id
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.writer import TraceWriter


class CannotBegin(Exception):
    """A run cannot begin where the devices are; the message says why."""


def end_unstarted(
    task: LoadedTask,
    spec: RunSpec,
    status: Literal["refused", "stopped"],
    why: str,
    reporter: Reporter,
) -> ReportedRun:
    """Return the result of a task that never ran, and write it, its events and its report to a folder, unless None."""
    result = TaskResult(task=task.assignment.name, status=status, seed=spec.seed, failure=why)
    if spec.out is None:
        return ReportedRun(result)
    from skillc_runtime.evaluation.report.write import write_report, write_result

    out = Path(spec.out)
    try:
        with writing_to(out):
            out.mkdir(parents=True, exist_ok=True)
            _record(task, spec, result, reporter, out)
            write_result(out, result)
            write_report(out, result, ())
    except ServiceError as error:
        reporter.say(f"error: {error}")
        return ReportedRun(result, written=False)
    return ReportedRun(result)


def _record(task: LoadedTask, spec: RunSpec, result: TaskResult, reporter: Reporter, out: Path) -> None:
    """Write the events of a task that starts and ends at the same time."""
    stopped = result.status == "stopped"
    failure = Failure(kind="halted" if stopped else "plan", message=result.failure or "")
    run, state, origin = make_run_id(result.task), task.world.snapshot(), CellOrigin(task.scene, spec.seed)
    describe = partial(describe_contents, run, result.task, task.library, KnownStart(state), origin, spec)
    with (
        recorded_in(out, describe, None, reporter) as recorders,
        TraceWriter(out / NAME) as writer,
    ):
        publish = Publisher(run, (writer, *recorders))
        publish(make_start_event(task.assignment, task.library, origin, 0.0, spec))
        publish(TaskEnded(time=0.0, task=result.task, status="stopped" if stopped else "failed", failure=failure))
