"""Reads the recordings of `skillc run --out`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, cast

import msgspec

from skillc.errors import RequestError, ServiceError
from skillc.services.reporting.files import inspect_path
from skillc.services.reporting.reporter import Reporter
from skillc_runtime.evaluation.report.result import RESULT, TaskResult
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.recording.history.history_builder import read_history
from skillc_runtime.recording.reader import TraceError, TraceReader
from skillc_runtime.recording.states import EndState

if TYPE_CHECKING:
    from skillc_runtime.recording.history.question import CallSelection
    from skillc_runtime.recording.mcap.reader import SignalTable

MCAP_MAGIC = b"\x89MCAP0\r\n"
NAME, RECORDING = "events.jsonl", "recording.mcap"
"""The files in the folder of a run that have its events; the second one has all else, too."""


def find_recording(run: Path) -> Path:
    """Return the file with the events of a run, given its folder or that file. ServiceError if there is none."""
    path = _choose_file(run) if inspect_path(run).kind == "folder" else run
    found = inspect_path(path)
    if found.kind == "missing":
        raise ServiceError(_missing(run))
    if found.kind != "file":
        raise ServiceError(f"{path} {found.is_what}")
    return path


def _choose_file(folder: Path) -> Path:
    """Return the file of a folder that is read: the one that has the end of a run whose process was killed."""
    found = folder / NAME, folder / RECORDING
    return next((each for each in found if inspect_path(each).kind != "missing"), found[0])


def read_run(run: Path, reporter: Reporter) -> RunHistory:
    """Read the recording of a run, given its folder or a file with its events. ServiceError if it cannot be read."""
    path = find_recording(run)
    with _reading(path, reporter) as envelopes:
        return _require_history(read_history(each.event for each in envelopes), str(path))


def read_envelopes(path: Path, reporter: Reporter) -> tuple[Envelope, ...]:
    """Read all events of a file. ServiceError if it cannot be read."""
    with _reading(path, reporter) as envelopes:
        return tuple(envelopes)


def read_signals(path: Path) -> SignalTable:
    """Read the signals of an MCAP file. ServiceError if it cannot be read."""
    from skillc_runtime.recording.mcap.reader import read_recording

    with _explaining(path):
        return read_recording(path).signals()


def find_mcap(folder: Path | None) -> Path | None:
    """Return the MCAP file in the folder of a run; None if there is none."""
    path = None if folder is None else folder / RECORDING
    return path if path is not None and path.is_file() else None


def is_mcap(path: Path) -> bool:
    """Whether a file is an MCAP file, by its first bytes or, if there are none, its name."""
    try:
        with path.open("rb") as file:
            begin = file.read(len(MCAP_MAGIC))
    except OSError:
        return False
    return begin == MCAP_MAGIC or path.suffix == ".mcap"


def read_result(path: Path, events: Sequence[Envelope]) -> TaskResult:
    """Return the result beside a file of a run; without one, what its events say. ServiceError if it cannot be read."""
    file = path.with_name(RESULT)
    if path.name in (NAME, RECORDING) and inspect_path(file).kind == "file":
        try:
            return msgspec.json.decode(file.read_bytes(), type=TaskResult)
        except (OSError, msgspec.MsgspecError) as error:
            raise ServiceError(f"{file} cannot be read: {error}") from error
    return make_result(events, str(path))


def make_result(events: Sequence[Envelope], name: str) -> TaskResult:
    """Return the result that the events of a run tell. ServiceError with its name if its task has not begun."""
    from skillc_runtime.evaluation.report.summary import summarise_recording  # it needs what measures

    history = _require_history(read_history(each.event for each in events), name)
    if not history.status:
        history = msgspec.structs.replace(history, status="interrupted")
    if not history.attempts:
        failure = describe_failure(history.failure) if history.failure else "it never began"
        return TaskResult(task=history.task, status=cast(EndState, history.status), failure=failure)
    wall_time_s = (events[-1].wall_time_ns - events[0].wall_time_ns) * 1e-9
    return summarise_recording(TaskResult(task=history.task, status="interrupted"), history, wall_time_s)


@contextmanager
def _reading(path: Path, reporter: Reporter) -> Iterator[Iterable[Envelope]]:
    """Read events in a `with` statement, and report if the file was cut off. ServiceError if it fails."""
    with _explaining(path):
        if is_mcap(path):
            from skillc_runtime.recording.mcap.reader import read_recording

            recorded = read_recording(path)
            yield recorded.envelopes
            note = f"note: {recorded.note}" if recorded.note else ""
        else:
            reader = TraceReader(path)
            yield reader
            cut = f"note: the last line of {path} is incomplete; the recording ends before it"
            note = cut if reader.is_truncated else ""
    if note:
        reporter.say(note)


@contextmanager
def _explaining(path: Path) -> Iterator[None]:
    """Turn the errors of readers in a `with` statement into ServiceError."""
    try:
        yield
    except TraceError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"{path} cannot be read: {error.strerror or error}") from error


def _require_history(history: RunHistory | None, name: str) -> RunHistory:
    if history is None:
        raise ServiceError(f"{name} has no events of a task: it has not begun, or the run ended before it")
    return history


def answer_question(story: RunHistory, question: str) -> CallSelection:
    """Return the answer to a question. RequestError if it is about something that is not in the recording."""
    from skillc.services.recording.rule_places import RulePlaces
    from skillc.services.scene.fact_places import FactPlaces
    from skillc_runtime.recording.history.question import QuestionError, select_calls

    rules, places = RulePlaces(story.scene), FactPlaces(story.scene)
    try:
        return select_calls(story, question, lambda fact: rules.find(fact) or places.find(fact))
    except QuestionError as error:
        raise RequestError(str(error)) from error


def _missing(run: Path) -> str:
    if inspect_path(run).kind != "folder":
        return f"there is no folder {run}; `skillc run TASK --out DIR` records a run in DIR, unless it is refused"
    others = sorted(str(each.parent) for each in run.glob(f"*/{NAME}"))
    if others:
        return f"{run} has no {NAME}; there are recordings in {', '.join(others)}"
    return f"{run} has no {NAME}: `skillc run TASK --out DIR` writes it, unless the task is refused before it starts"
