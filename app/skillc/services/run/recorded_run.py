"""A run whose events are recorded and whose process is watched: its end is written, whatever ends it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec

from skillc.services.recording.recordings import NAME
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc.services.watchdog.ending import RunDescription, write_interrupted_end
from skillc.services.watchdog.process import TICK_TIMEOUT_S, watching
from skillc_runtime.evaluation.report.result import REPORT, RESULT, TaskResult
from skillc_runtime.platforms.watchdog_program import STATE, SharedState
from skillc_runtime.recording.envelope import Recorder, make_run_id
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.reader import TraceError
from skillc_runtime.recording.writer import TraceWriter


class RecordingOptions(msgspec.Struct, frozen=True):
    """The folder of recording and result (None: none that stays), and how long a tick may take in s (0: any time).

    With `prints_json` the caller prints the result as JSON; the watchdog does if the run is interrupted. Without a
    time-out nothing watches this process and handles its signals. `run` is the id of the run, empty for a new one;
    `recorders` get its events too.
    """

    out: Path | None = None
    tick_timeout_s: float | None = TICK_TIMEOUT_S
    prints_json: bool = False
    run: str = ""
    recorders: tuple[Recorder, ...] = ()


class RecordedRun(msgspec.Struct, frozen=True):
    """The listener that records the events of a run, and the memory that counts its ticks."""

    publisher: Publisher
    watchdog: SharedState


@contextmanager
def recorded_run(start: TaskResult, options: RecordingOptions, reporter: Reporter) -> Iterator[RecordedRun]:
    """Record and watch a run in a `with` statement; `start` is its result as far as it is known when it starts.

    If the block raises, the end of the run is written as `interrupted`, unless it was recorded. ServiceError if the
    folder cannot be written to, or the watchdog cannot be started.
    """
    with TemporaryDirectory(prefix="skillc-run-", ignore_cleanup_errors=True) as private:
        folder = options.out or Path(private)
        run = RunDescription(
            events=str((folder / NAME).absolute()),
            out=None if options.out is None else str(options.out.absolute()),
            start=start,
            began_s=time.time(),
            timeout_s=options.tick_timeout_s or 0.0,
            prints_json=options.prints_json,
        )
        with _writer(folder, reporter) as writer:
            watchdog = SharedState(Path(private) / STATE)
            try:
                watched = nullcontext() if options.tick_timeout_s is None else watching(Path(private), run, watchdog)
                with watched:
                    publisher = Publisher(options.run or make_run_id(start.task), (writer, *options.recorders))
                    yield RecordedRun(publisher, watchdog)
            except BaseException as error:
                writer.close()
                _write_end(run, error, watchdog.now, reporter)
                raise


@contextmanager
def _writer(folder: Path, reporter: Reporter) -> Iterator[TraceWriter]:
    """Open the recording of a new run; the result of another run in the same folder is removed."""
    with writing_to(folder):
        folder.mkdir(parents=True, exist_ok=True)
        for name in (RESULT, REPORT):
            (folder / name).unlink(missing_ok=True)
        writer = TraceWriter(folder / NAME)
    with writer:
        yield writer
    if writer.problem is not None:
        reporter.say(f"warning: {writer.problem}")


def _write_end(run: RunDescription, error: BaseException, now: float, reporter: Reporter) -> None:
    why = "it was interrupted twice" if isinstance(error, KeyboardInterrupt) else f"{type(error).__name__}: {error}"
    try:
        write_interrupted_end(run, why, now)
    except (OSError, TraceError) as problem:
        reporter.say(f"warning: the end of the run cannot be written: {problem}")
