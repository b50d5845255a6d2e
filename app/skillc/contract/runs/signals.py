"""Recorded signals of a run."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc_runtime.recording.signals.signal import Signal


class SignalRows(msgspec.Struct, frozen=True):
    """Signals at the times `time_s` of the cell; each of `signals` has its column in `columns`, null where unknown.

    `every_s` is how far apart these rows are at least. `more` if there are later ones.
    """

    time_s: tuple[float, ...]
    signals: tuple[Signal, ...]
    columns: tuple[tuple[float | None, ...], ...]
    every_s: float
    more: bool


Seconds = Annotated[float, msgspec.Meta(ge=0.0, le=1e9)]


class SignalPage(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Which signals: those whose columns contain one of the words in `match`, separated by commas; all without.

    Those after `after_s` until `until_s` of the cell's time, `every_s` apart at least.
    """

    match: Annotated[str, msgspec.Meta(max_length=500)] = ""
    after_s: Annotated[float, msgspec.Meta(ge=-1.0, le=1e9)] = -1.0
    until_s: Seconds = 1e9
    every_s: Seconds = 0.0
