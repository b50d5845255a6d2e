"""Reads the recordings of `skillc run --out`."""

from __future__ import annotations

from pathlib import Path

from skillc.services.errors import RequestError, ServiceError
from skillc.services.files import inspect_path
from skillc.services.reporting import Reporter
from skillc_runtime.recording.history import RunHistory
from skillc_runtime.recording.history_builder import read_history
from skillc_runtime.recording.question import CallSelection, QuestionError, select_calls
from skillc_runtime.recording.reader import TraceError, TraceReader

NAME = "events.jsonl"


def read_run(run: Path, reporter: Reporter) -> RunHistory:
    """Read the recording of a run, given its folder or its event file. ServiceError if it cannot be read."""
    path = run / NAME if inspect_path(run).kind == "folder" else run
    found = inspect_path(path)
    if found.kind == "missing":
        raise ServiceError(_missing(run))
    if found.kind != "file":
        raise ServiceError(f"{path} {found.is_what}")
    reader = TraceReader(path)
    try:
        story = read_history(reader.events)
    except TraceError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"{path} cannot be read: {error.strerror or error}") from error
    if story is None:
        raise ServiceError(f"{path} has no events of a task: the run ended before the task began")
    if reader.is_truncated:
        reporter.say(f"note: the last line of {path} is incomplete; the recording ends at {story.last:.1f} s")
    return story


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
