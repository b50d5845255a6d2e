"""Questions about recorded runs that a process answers: trees, reasons, signals and differences.

What that needs is imported when one is answered, so that a server, which only passes them on, starts sooner.
"""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from skillc.contract.runs.explanation import ChainedFailure, ExplainedCall, RunExplanation
from skillc.contract.runs.run_diff import RunDiff
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalPage, SignalRows
from skillc.errors import ServiceError

if TYPE_CHECKING:
    from skillc.services.run_diff.recorded import RecordedRunData
    from skillc_model.skills import SkillLibrary
    from skillc_runtime.recording.envelope import Envelope
    from skillc_runtime.recording.history.history import RecordedCall
    from skillc_runtime.recording.mcap.reader import RecordedFile

MAX_ROWS = 5000
"""How many rows of signals are returned."""
MAX_VALUES = 200_000
"""How many values of signals are returned."""


@dataclass(frozen=True, slots=True)
class RunFiles:
    """Where a run is: its events in the journal of its cell, the rest in its recording, if there is one."""

    operation: str
    journal: Path
    recording: Path


def show_tree(run: RunFiles) -> OperationTree:
    """Show the tree of a run, with the library in its recording; ServiceError if it has none."""
    from skillc.services.run.operation_tree import build_tree

    return build_tree(_read_events(run), _read_library(run))


def compare_runs(first: RunFiles, second: RunFiles) -> RunDiff:
    """Compare two runs; one that goes on as far as it is."""
    from skillc.services.run_diff.compare import compare_runs as compare

    return compare(_read_run(first), _read_run(second))


def _read_events(run: RunFiles) -> tuple[Envelope, ...]:
    """Return all events of a run up to now."""
    from skillc.cells.journal.reading import JournalReader

    found: list[Envelope] = []
    with closing(JournalReader(run.journal)) as reader:
        while page := reader.envelopes(run.operation, found[-1].sequence if found else 0):
            found += page
    return tuple(found)


def _read_library(run: RunFiles) -> SkillLibrary:
    """Return the library that a run uses; ServiceError if its recording does not have it."""
    from skillc_model.codec import LibraryError, loads
    from skillc_runtime.recording.mcap.contents import LIBRARY

    attachments = _open_recording(run).attachments
    if LIBRARY not in attachments:
        raise ServiceError(f"the recording of {run.operation} has no library yet; try again")
    try:
        return loads(attachments[LIBRARY], f"the library of {run.operation}")
    except LibraryError as error:
        raise ServiceError(str(error)) from error


def _open_recording(run: RunFiles) -> RecordedFile:
    from skillc_runtime.recording.mcap.reader import read_recording
    from skillc_runtime.recording.reader import TraceError

    try:
        return read_recording(run.recording)
    except (OSError, TraceError) as error:
        raise ServiceError(f"the recording of {run.operation} cannot be read: {error}") from error


def explain_run(run: RunFiles, question: str) -> RunExplanation:
    """Explain a run; a question is one of `skillc why`, or empty."""
    from skillc.services.recording.recordings import answer_question
    from skillc.services.recording.story_text import format_answer, overview_lines
    from skillc_runtime.recording.history.history_builder import read_history

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
    from skillc.services.recording.story_text import explain_call

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


def read_signals(run: RunFiles, page: SignalPage) -> SignalRows:
    """Read the signals of a page; ServiceError if nothing is recorded."""
    from skillc.services.recording import recordings

    if not run.recording.exists():
        raise ServiceError(f"there is no recording of {run.operation}")
    table, match = recordings.read_signals(run.recording), [*filter(None, page.match.split(","))]
    wanted = [
        number for number, each in enumerate(table.signals) if not match or any(part in each.column for part in match)
    ]
    rows = np.flatnonzero((table.time_s > page.after_s) & (table.time_s <= page.until_s))
    period_s = float(np.median(np.diff(table.time_s))) if len(table.time_s) > 1 else 0.0
    step = max(1, round(page.every_s / period_s)) if period_s > 0.0 else 1
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
    from skillc.services.recording.recordings import make_result
    from skillc.services.run_diff.recorded import make_run_data, read_mcap_columns

    envelopes, recording = _read_events(run), run.recording
    result = make_result(envelopes, run.operation)
    signals = read_mcap_columns(recording) if recording.exists() and recording.stat().st_size else None
    return make_run_data(run.operation, envelopes, result, signals)
