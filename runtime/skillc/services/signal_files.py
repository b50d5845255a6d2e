"""Records the signals of a run beside its events: `skillc run --signals`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Literal, TypeAlias

from skillc.services.errors import RequestError
from skillc.services.files import writing_to
from skillc.services.reporting import Reporter
from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.recording.signals.files import CSV, PARQUET, CsvSink, ParquetSink, write_dictionary
from skillc_runtime.recording.signals.sampler import SignalSampler
from skillc_runtime.recording.signals.signal import Signal, SignalSink

SignalFormat: TypeAlias = Literal["csv", "parquet"]


def check_signals(form: SignalFormat | None, folder: Path | None) -> None:
    """Raise RequestError if signals cannot be recorded: there is no folder for them, or a package is missing."""
    if form is not None and folder is None:
        raise RequestError("--signals records to a folder, which --out names")
    if form == "parquet" and find_spec("pyarrow") is None:
        raise RequestError("--signals parquet needs the package pyarrow: pip install 'skillc[data]'")


@contextmanager
def recorded_signals(
    simulation: Simulation, form: SignalFormat | None, folder: Path | None, reporter: Reporter
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
        sampler = SignalSampler(simulation, make_sink)
    with closing(sampler):
        yield (sampler.sample,)
    if sampler.problem is not None:
        reporter.say(f"error: {file} is not complete: {sampler.problem}")
