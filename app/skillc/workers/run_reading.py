"""What the workers for recorded runs do: they read events, trees, reasons and signals, and compare runs."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from typing import TypeAlias, assert_never

import msgspec
import numpy as np

from skillc.cells.database import DatabaseError
from skillc.cells.journal.reading import JournalReader
from skillc.contract.diagnosis import WorkRefused
from skillc.contract.runs.explanation import ChainedFailure, ExplainedCall, RunExplanation
from skillc.contract.runs.run_diff import RunDiff
from skillc.contract.runs.run_questions import CompareRuns, ExplainRun, ReadSignals, RunFiles, RunQuestion, ShowTree
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalRows
from skillc.errors import ServiceError
from skillc.services.recording.recordings import answer_question, make_result, read_signals
from skillc.services.recording.story_text import explain_call, format_answer, overview_lines
from skillc.services.run.operation_tree import build_tree
from skillc.services.run_diff.compare import compare_runs
from skillc.services.run_diff.recorded import RecordedRunData, make_run_data, read_mcap_columns
from skillc_model.codec import LibraryError, loads
from skillc_model.skills import SkillLibrary
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.history.history import RecordedCall
from skillc_runtime.recording.history.history_builder import read_history
from skillc_runtime.recording.mcap.contents import LIBRARY
from skillc_runtime.recording.mcap.reader import RecordedFile, read_recording
from skillc_runtime.recording.reader import TraceError

MAX_ROWS = 5000
"""How many rows of signals are returned."""
MAX_VALUES = 200_000
"""How many values of signals are returned."""

RunAnswer: TypeAlias = OperationTree | RunExplanation | SignalRows | RunDiff


def answer_run_question(request: tuple[RunQuestion, bytes] | None) -> bytes | WorkRefused:
    """Return the answer to a job as JSON, or why there is none; None asks if it is ready. A snapshot is not needed."""
    if request is None:
        return b""
    try:
        return msgspec.json.encode(_answer(request[0]))
    except (ServiceError, DatabaseError) as error:
        return WorkRefused(str(error))
    except MemoryError:
        return WorkRefused("it needs too much memory; ask for less")


def _answer(job: RunQuestion) -> RunAnswer:
    match job:
        case ShowTree(run):
            return build_tree(_read_events(run), _read_library(run))
        case ExplainRun(run, question):
            return _explain(run, question)
        case ReadSignals():
            return _read_signals(job)
        case CompareRuns(first, second):
            return compare_runs(_read_run(first), _read_run(second))
        case _:
            assert_never(job)


def _read_events(run: RunFiles) -> tuple[Envelope, ...]:
    """Return all events of a run up to now."""
    found = list[Envelope]()
    with closing(JournalReader(Path(run.journal))) as reader:
        while page := reader.envelopes(run.operation, found[-1].sequence if found else 0):
            found += page
    return tuple(found)


def _read_library(run: RunFiles) -> SkillLibrary:
    """Return the library that a run uses; ServiceError if its recording does not have it."""
    attachments = _open_recording(run).attachments
    if LIBRARY not in attachments:
        raise ServiceError(f"the recording of {run.operation} has no library yet; try again")
    try:
        return loads(attachments[LIBRARY], f"the library of {run.operation}")
    except LibraryError as error:
        raise ServiceError(str(error)) from error


def _open_recording(run: RunFiles) -> RecordedFile:
    try:
        return read_recording(Path(run.recording))
    except (OSError, TraceError) as error:
        raise ServiceError(f"the recording of {run.operation} cannot be read: {error}") from error


def _explain(run: RunFiles, question: str) -> RunExplanation:
    envelopes = _read_events(run)
    story = read_history(each.event for each in envelopes)
    if story is None:
        return RunExplanation(len(envelopes), (), (), (), ())
    answer = answer_question(story, question) if question else None
    return RunExplanation(
        sequence=envelopes[-1].sequence,
        lines=tuple(overview_lines(story)),
        chain=tuple(ChainedFailure(each.name, each.message, each.source) for each in story.chain),
        calls=tuple(_explain_call(each) for each in story.calls),
        answer=tuple(format_answer(answer).splitlines()) if answer is not None else (),
        origins=answer.origins if answer is not None else (),
    )


def _explain_call(call: RecordedCall) -> ExplainedCall:
    return ExplainedCall(
        number=call.number,
        skill=call.skill,
        status=call.status,
        lines=tuple(explain_call(call)),
        node=call.node,
        source=call.source,
        implementation_source=call.implementation_source,
        parameters=tuple(call.bindings),
    )


def _read_signals(job: ReadSignals) -> SignalRows:
    if not Path(job.run.recording).exists():
        raise ServiceError(f"there is no recording of {job.run.operation}")
    table = read_signals(Path(job.run.recording))
    wanted = [
        number
        for number, each in enumerate(table.signals)
        if not job.match or any(part in each.column for part in job.match)
    ]
    rows = np.flatnonzero((table.time_s > job.after_s) & (table.time_s <= job.until_s))
    period_s = float(np.median(np.diff(table.time_s))) if len(table.time_s) > 1 else 0.0
    step = max(1, round(job.every_s / period_s)) if period_s > 0.0 else 1
    chosen = rows[::step]
    limit = max(1, min(MAX_ROWS, MAX_VALUES // max(1, len(wanted))))
    values = table.rows[chosen[:limit]][:, wanted]
    return SignalRows(
        time_s=tuple(table.time_s[chosen[:limit]].tolist()),
        signals=tuple(table.signals[each] for each in wanted),
        columns=tuple(tuple(None if each != each else each for each in column) for column in values.T.tolist()),
        every_s=round(step * period_s, 9),
        more=len(chosen) > limit,
    )


def _read_run(run: RunFiles) -> RecordedRunData:
    """Read a run, also while it goes on: the journal has its events before the recording does."""
    envelopes, recording = _read_events(run), Path(run.recording)
    result = make_result(envelopes, run.operation)
    signals = read_mcap_columns(recording) if recording.exists() and recording.stat().st_size else None
    return make_run_data(run.operation, envelopes, result, signals)
