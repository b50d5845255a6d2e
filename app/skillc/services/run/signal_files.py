"""Records the signals of a run beside its events: `skillc run --signals`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Literal, TypeAlias

import msgspec

from skillc.errors import RequestError, ServiceError
from skillc.extras import require
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc_runtime.devices.backend import Backend
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.recording.signals.files import (
    CSV,
    DICTIONARY,
    PARQUET,
    CsvSink,
    ParquetSink,
    SignalDictionary,
    write_dictionary,
)
from skillc_runtime.recording.signals.sampler import SignalSampler
from skillc_runtime.recording.signals.signal import Signal, SignalSink

SignalFormat: TypeAlias = Literal["csv", "parquet"]


def check_signals(form: SignalFormat | None, folder: str | None) -> None:
    """Raise RequestError if signals cannot be recorded: there is no folder for them, or a package is missing."""
    if form is not None and folder is None:
        raise RequestError("--signals records to a folder, which --out names")
    if form == "parquet":
        require("--signals parquet", "data")


def read_signal_dictionary(folder: Path | None) -> SignalDictionary:
    """Return what is recorded beside the signals in a folder: their file and their columns.

    RequestError if no signals were recorded there, ServiceError if that cannot be read.
    """
    file = None if folder is None else folder / DICTIONARY
    if file is None or not file.exists():
        raise RequestError(f"no signals were recorded{'' if folder is None else f' in {folder}'}; run with `signals`")
    try:
        return msgspec.json.decode(file.read_bytes(), type=SignalDictionary)
    except (OSError, msgspec.DecodeError) as error:
        raise ServiceError(f"{file} cannot be read: {error}") from error


@contextmanager
def recorded_signals(
    backend: Backend, form: SignalFormat | None, folder: Path | None, reporter: Reporter
) -> Iterator[tuple[Callable[[], None], ...]]:
    """Record signals in a `with` statement; yields what is to be called in every tick: nothing without a format.

    ServiceError if the folder cannot be written to.
    """
    if form is None or folder is None:
        yield ()
        return
    file = folder / (CSV if form == "csv" else PARQUET)

    def make_sink(signals: Sequence[Signal]) -> SignalSink:
        write_dictionary(folder, file.name, signals, TICK_S)
        return CsvSink(file, signals) if form == "csv" else ParquetSink(file, signals, TICK_S)

    with writing_to(folder):
        folder.mkdir(parents=True, exist_ok=True)
        sampler = SignalSampler(backend, make_sink)
    with closing(sampler):
        yield (sampler.sample,)
    if sampler.problem is not None:
        reporter.say(f"error: {file} is not complete: {sampler.problem}")
