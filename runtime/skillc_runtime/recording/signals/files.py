"""Writes signals as CSV or Parquet, with a data dictionary: signals.json, and the metadata of Parquet columns."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.signals.signal import Signal

CSV, PARQUET, DICTIONARY = "signals.csv", "signals.parquet", "signals.json"
FORMAT = 1
"""Raised with every change of the names or the meaning of columns."""
ROWS = 1024
"""The number of rows that are written to Parquet at once."""
_DIGITS = 9


class SignalDictionary(msgspec.Struct, frozen=True):
    """The columns of a file of signals, in order; `period_s` is the time of the cell between two rows."""

    format: int
    file: str
    period_s: float
    signals: tuple[Signal, ...]


def write_dictionary(folder: Path, file: str, signals: Sequence[Signal], period_s: float) -> None:
    """Write signals.json; OSError."""
    content = msgspec.json.encode(SignalDictionary(FORMAT, file, period_s, tuple(signals)))
    (folder / DICTIONARY).write_bytes(msgspec.json.format(content, indent=1) + b"\n")


class CsvSink:
    """Writes a row as soon as it is sampled; what is not known is empty. OSError if the file cannot be written."""

    def __init__(self, path: Path, signals: Sequence[Signal]) -> None:
        self._file = path.open("w", encoding="utf-8", newline="")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow([signal.column for signal in signals])

    def write(self, row: Array) -> None:
        """Write a row, with nine significant digits."""
        self._writer.writerow(["" if value != value else f"{value:.{_DIGITS}g}" for value in row.tolist()])

    def close(self) -> None:
        """Close the file."""
        self._file.close()


class ParquetSink:
    """Writes ROWS rows at once, as float64; the file can be read once it is closed. OSError; needs pyarrow."""

    def __init__(self, path: Path, signals: Sequence[Signal], period_s: float) -> None:
        import pyarrow as pa
        import pyarrow.parquet as pq

        self._pa: Any = pa
        fields = [pa.field(each.column, pa.float64(), metadata=_metadata(each)) for each in signals]
        about = {"skillc.signals.format": str(FORMAT), "skillc.signals.period_s": str(period_s)}
        self._schema = pa.schema(fields, metadata=about)
        self._writer: Any = pq.ParquetWriter(path, self._schema)
        self._rows = np.empty((ROWS, len(signals)))
        self._count = 0

    def write(self, row: Array) -> None:
        """Keep a row, and write what is kept if it is enough."""
        self._rows[self._count] = row
        self._count += 1
        if self._count == ROWS:
            self._flush()

    def close(self) -> None:
        """Write what is left and the end of the file."""
        if self._writer.is_open:
            self._flush()
            self._writer.close()

    def _flush(self) -> None:
        columns = [self._pa.array(column, mask=np.isnan(column)) for column in self._rows[: self._count].T.copy()]
        if self._count:
            self._writer.write_table(self._pa.Table.from_arrays(columns, schema=self._schema))
        self._count = 0


def _metadata(signal: Signal) -> dict[str, str]:
    return {name: value for name, value in msgspec.to_builtins(signal).items() if name != "column"}
