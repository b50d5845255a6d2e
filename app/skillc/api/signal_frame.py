"""Recorded signals as pandas frames."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from skillc.errors import ServiceError
from skillc.services.recording.recordings import read_signals
from skillc.services.run.signal_files import read_signal_dictionary
from skillc.values.frames import import_pandas
from skillc_runtime.recording.signals.files import DICTIONARY
from skillc_runtime.recording.signals.signal import CLOCK

if TYPE_CHECKING:
    import pandas as pd


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
