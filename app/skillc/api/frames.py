"""Records as pandas frames and as HTML tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from skillc.errors import ServiceError
from skillc.services.recordings import read_signals
from skillc.services.signal_files import read_signal_dictionary
from skillc_runtime.recording.signals.files import DICTIONARY
from skillc_runtime.recording.signals.signal import CLOCK

if TYPE_CHECKING:
    import pandas as pd

SHOWN_ROWS = 30
"""How many rows a table shows in a notebook."""


def make_frame(rows: Iterable[Mapping[str, Any]], columns: Sequence[str] | None = None) -> pd.DataFrame:
    """Return records as a frame. ServiceError if pandas is not installed."""
    return import_pandas().DataFrame(list(rows), columns=None if columns is None else list(columns))


def read_signal_frame(folder: Path | None, recording: Path | None) -> pd.DataFrame:
    """Return the signals that were recorded in a folder, by the time of the cell in s, with their units in `attrs`.

    Without them it is the signals of a recording, an MCAP file. RequestError if there are none; ServiceError if they
    cannot be read, or pandas is not installed.
    """
    if recording is not None and (folder is None or not (folder / DICTIONARY).exists()):
        table, pandas = read_signals(recording), import_pandas()
        index = pandas.Index(table.time_s, name=CLOCK.column)
        frame = pandas.DataFrame(table.rows, index, [each.column for each in table.signals])
        frame.attrs["units"] = {each.column: each.unit for each in table.signals}
        return frame
    dictionary = read_signal_dictionary(folder)
    assert folder is not None, "a folder with signals"
    file, pandas = folder / dictionary.file, import_pandas()
    try:
        frame = pandas.read_parquet(file) if file.suffix == ".parquet" else pandas.read_csv(file)
    except (OSError, ValueError, ImportError) as error:
        raise ServiceError(f"{file} cannot be read: {error}") from error
    frame.attrs["units"] = {each.column: each.unit for each in dictionary.signals}
    return frame.set_index(CLOCK.column)


def import_pandas() -> Any:
    """Return pandas. ServiceError if it is not installed."""
    try:
        import pandas as pd
    except ImportError as error:
        raise ServiceError("frames require pandas: `pip install 'skillc[data]'` installs it") from error
    return pd


def make_table(columns: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """Return an HTML table of texts; the number of rows that it leaves out is written below it."""
    head = "".join(f"<th>{escape(each)}</th>" for each in columns)
    body = "".join(_row(each) for each in rows[:SHOWN_ROWS])
    more = f"<p>and {len(rows) - SHOWN_ROWS} more rows</p>" if len(rows) > SHOWN_ROWS else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"


def _row(cells: Sequence[object]) -> str:
    return "<tr>" + "".join(f"<td>{escape('' if each is None else str(each))}</td>" for each in cells) + "</tr>"
