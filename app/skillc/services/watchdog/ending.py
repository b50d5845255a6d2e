"""Writes the end of a run that could not write it itself: `python -m skillc.services.watchdog.ending FOLDER REASON`."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path

import msgspec
from msgspec import structs

from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.platforms.watchdog_program import STATE, SharedState
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.recording.history.history_builder import HistoryBuilder, listen_to
from skillc_runtime.recording.reader import TraceError, TraceReader

DESCRIPTION = "run.json"


class RunDescription(msgspec.Struct, frozen=True, kw_only=True):
    """What is known of a run when it starts; `start` is its result if nothing is recorded.

    `events` is the file of its events, `out` the folder for its result, None for none. `began_s` is the time at which
    it started, in s since 1970. With `prints_json` its result is printed.
    """

    events: str
    out: str | None
    start: TaskResult
    began_s: float
    timeout_s: float
    prints_json: bool = False


def write_interrupted_end(run: RunDescription, why: str, now: float) -> TaskResult:
    """Write the last event, the result and the report of a run that ended without them; return the result.

    `why` is the reason, to which the calls that ran are added, `now` the time of the cell in s. A recording that has
    its last event keeps it. OSError or TraceError if the files cannot be read or written.
    """
    # The process that is watched imports this module too, and has no use for what makes results and reports of that.
    from skillc_runtime.evaluation.report.summary import summarise_recording
    from skillc_runtime.evaluation.report.write import write_report, write_result

    builder = _end_recording(Path(run.events), lambda history: f"{why}{_describe_place(history)}", now)
    wall_s = time.time() - run.began_s
    history = builder.build()
    if history is None:
        result = structs.replace(run.start, wall_time_s=wall_s, failure=f"{why}, before the task began")
    else:
        result = summarise_recording(run.start, history, wall_s)
    if run.out is not None:
        write_result(Path(run.out), result)
        write_report(Path(run.out), result, builder.draw())
    return result


def _describe_place(history: RunHistory) -> str:
    """Describe the innermost calls that were running, each with the line of its implementation."""
    running = _find_innermost(history.calls)
    places = [f"{call.skill}[{call.implementation}] ({call.implementation_source})" for call in running]
    return f", in {' and '.join(places)}" if places else ""


def _find_innermost(calls: Iterable[RecordedCall]) -> list[RecordedCall]:
    running = [call for call in calls if call.status == "running" and call.implementation]
    return [call for call in running if not any(inner.status == "running" for inner in call.calls)]


def main(folder: Path, reason: str) -> None:
    """Write the end of the run that a folder describes, and print a sentence about it."""
    run = msgspec.json.decode((folder / DESCRIPTION).read_bytes(), type=RunDescription)
    blocked = f"no tick ended within {run.timeout_s:g} s, so its process was ended"
    why = blocked if reason == "blocked" else "its process ended without notice"
    try:
        result = write_interrupted_end(run, why, SharedState(folder / STATE).now)
    except (OSError, TraceError) as error:
        print(f"error: {run.start.task}: {why}, and its end cannot be written: {error}", file=sys.stderr)
        return
    if result.status == "interrupted":
        print(f"error: {result.task} was interrupted: {result.failure}", file=sys.stderr)
    else:
        print(f"warning: {result.task} had {result.status}: {why}, before its report was written", file=sys.stderr)
    if run.prints_json:
        print(msgspec.json.format(msgspec.json.encode(result), indent=2).decode())


def _end_recording(path: Path, explain: Callable[[RunHistory], str], now: float) -> HistoryBuilder:
    """End a recording as `interrupted` at the time `now` of the cell in s, if it has no end, and build its history.

    `explain` returns the reason for the history up to then. An incomplete last line is removed. TraceError if the file
    is not a recording, OSError if it cannot be read or written; no other program may write to it.
    """
    reader = TraceReader(path)
    envelopes = list(reader)
    told = listen_to(envelope.event for envelope in envelopes)
    history = told.build()
    if history is None or history.status:
        return told
    last = envelopes[-1]
    ended = TaskEnded(
        time=max(now, last.cell_time_s),
        task=history.task,
        status="interrupted",
        failure=Failure(kind="interrupted", message=explain(history)),
    )
    _append(path, Envelope(run=last.run, sequence=last.sequence + 1, wall_time_ns=time.time_ns(), event=ended))
    told(ended)
    return told


def _append(path: Path, envelope: Envelope) -> None:
    """Append an envelope in place of an incomplete last line."""
    with path.open("r+b") as file:
        content = file.read()
        file.truncate(content.rfind(b"\n") + 1)
        file.seek(0, 2)
        file.write(msgspec.json.encode(envelope) + b"\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
