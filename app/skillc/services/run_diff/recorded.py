"""Reads what is compared of a recorded run."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from skillc.errors import ServiceError
from skillc.services.recording.recordings import (
    find_mcap,
    find_recording,
    is_mcap,
    read_envelopes,
    read_result,
    read_signals,
)
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.signal_files import read_signal_dictionary
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import Event, TaskStarted
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.recording.history.history_builder import read_history
from skillc_runtime.recording.signals.files import DICTIONARY
from skillc_runtime.recording.signals.signal import CLOCK


@dataclass(frozen=True, slots=True)
class RecordedRunData:
    """A run as it was recorded; `signals` has the samples (n,) of each column, None if none were recorded."""

    name: str
    start: TaskStarted
    events: tuple[Event, ...]
    history: RunHistory
    result: TaskResult
    signals: Mapping[str, Array] | None


def read_recorded_run(run: Path, reporter: Reporter) -> RecordedRunData:
    """Read a run, given its folder or its recording. ServiceError if that is not possible."""
    path = find_recording(run)
    envelopes = read_envelopes(path, reporter)
    return make_run_data(str(run), envelopes, read_result(path, envelopes), _find_signals(path))


def make_run_data(
    name: str, envelopes: Sequence[Envelope], result: TaskResult, signals: Mapping[str, Array] | None
) -> RecordedRunData:
    """Return what is compared of a run, given its events with the start of its task, and its signals."""
    events = tuple(each.event for each in envelopes)
    history = read_history(events)
    assert history is not None, "a run without history has no result"
    start = next(event for event in events if isinstance(event, TaskStarted))
    return RecordedRunData(name, start, events, history, result, signals)


def read_mcap_columns(path: Path) -> Mapping[str, Array]:
    """Return the columns of the signals in an MCAP file. ServiceError if it cannot be read."""
    table = read_signals(path)
    return {each.column: table.column(each.column) for each in table.signals}


def _find_signals(path: Path) -> Mapping[str, Array] | None:
    """Return the columns of the signals beside or in a recording; None if there are none. ServiceError if unreadable.

    Those that `--signals` recorded come first: they have ground truth too.
    """
    if (path.parent / DICTIONARY).exists() and not is_mcap(path):
        return _read_files(path.parent)
    mcap = path if is_mcap(path) else find_mcap(path.parent)
    return None if mcap is None else read_mcap_columns(mcap)


def _read_files(folder: Path) -> Mapping[str, Array]:
    file = folder / read_signal_dictionary(folder).file
    try:
        columns = _read_parquet(file) if file.suffix == ".parquet" else _read_csv(file)
    except (OSError, ValueError, ImportError, csv.Error) as error:
        raise ServiceError(f"{file} cannot be read: {error}") from error
    return {name: values for name, values in columns.items() if name != CLOCK.column}


def _read_csv(file: Path) -> dict[str, Array]:
    with file.open(encoding="utf-8", newline="") as lines:
        header, *rows = list(csv.reader(lines)) or [[]]
    whole = [row for row in rows if len(row) == len(header)]
    table = np.array([[float(cell) if cell else np.nan for cell in row] for row in whole])
    return dict(zip(header, table.T, strict=True)) if whole else {}


def _read_parquet(file: Path) -> dict[str, Array]:
    import pyarrow.parquet as pq

    table: Any = pq.read_table(file)
    return {name: table.column(name).to_numpy(zero_copy_only=False) for name in table.column_names}
