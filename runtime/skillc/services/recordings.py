"""Reads the recordings of `skillc run --out`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import cast

import msgspec

from skillc.services.errors import RequestError, ServiceError
from skillc.services.files import inspect_path
from skillc.services.reporting import Reporter
from skillc_runtime.evaluation.report.interrupted import summarise_recording
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.write import RESULT
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.history import RunHistory
from skillc_runtime.recording.history_builder import read_history
from skillc_runtime.recording.question import CallSelection, QuestionError, select_calls
from skillc_runtime.recording.reader import TraceError, TraceReader
from skillc_runtime.recording.states import EndState

NAME = "events.jsonl"


def find_recording(run: Path) -> Path:
    """Return the event file of a run, given its folder or that file. ServiceError if there is none."""
    path = run / NAME if inspect_path(run).kind == "folder" else run
    found = inspect_path(path)
    if found.kind == "missing":
        raise ServiceError(_missing(run))
    if found.kind != "file":
        raise ServiceError(f"{path} {found.is_what}")
    return path


def read_run(run: Path, reporter: Reporter) -> RunHistory:
    """Read the recording of a run, given its folder or its event file. ServiceError if it cannot be read."""
    path = find_recording(run)
    with _reading(path, reporter) as reader:
        return _require_history(read_history(reader.events), path)


def read_envelopes(path: Path, reporter: Reporter) -> tuple[Envelope, ...]:
    """Read all events of an event file. ServiceError if it cannot be read."""
    with _reading(path, reporter) as reader:
        return tuple(reader)


def read_result(path: Path, events: Sequence[Envelope]) -> TaskResult:
    """Return the result beside an event file; without one, what its events say. ServiceError if it cannot be read."""
    file = path.with_name(RESULT)
    if inspect_path(file).kind == "file":
        try:
            return msgspec.json.decode(file.read_bytes(), type=TaskResult)
        except (OSError, msgspec.MsgspecError) as error:
            raise ServiceError(f"{file} cannot be read: {error}") from error
    history = _require_history(read_history(each.event for each in events), path)
    if not history.status:
        history = msgspec.structs.replace(history, status="interrupted")
    if not history.attempts:
        failure = describe_failure(history.failure) if history.failure else "it never began"
        return TaskResult(task=history.task, status=cast(EndState, history.status), failure=failure)
    return summarise_recording(TaskResult(task=history.task, status="interrupted"), history, 0.0)


@contextmanager
def _reading(path: Path, reporter: Reporter) -> Iterator[TraceReader]:
    """Read a recording in a `with` statement, and report an incomplete last line. ServiceError if it fails."""
    reader = TraceReader(path)
    try:
        yield reader
    except TraceError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"{path} cannot be read: {error.strerror or error}") from error
    if reader.is_truncated:
        reporter.say(f"note: the last line of {path} is incomplete; the recording ends before it")


def _require_history(history: RunHistory | None, path: Path) -> RunHistory:
    if history is None:
        raise ServiceError(f"{path} has no events of a task: the run ended before the task began")
    return history


def answer_question(story: RunHistory, question: str) -> CallSelection:
    """Return the answer to a question. RequestError if it is about something that is not in the recording."""
    try:
        return select_calls(story, question)
    except QuestionError as error:
        raise RequestError(str(error)) from error


def _missing(run: Path) -> str:
    if inspect_path(run).kind != "folder":
        return f"there is no folder {run}; `skillc run TASK --out DIR` records a run in DIR, unless it is refused"
    others = sorted(str(each.parent) for each in run.glob(f"*/{NAME}"))
    if others:
        return f"{run} has no {NAME}; there are recordings in {', '.join(others)}"
    return f"{run} has no {NAME}: `skillc run TASK --out DIR` writes it, unless the task is refused before it starts"
