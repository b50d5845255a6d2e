"""An event of a run as it is recorded: with the run that it belongs to, its number there, and the wall-clock time."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime
from secrets import token_hex
from typing import TypeAlias

import msgspec

from skillc_runtime.recording.events import Event


class Envelope(msgspec.Struct, frozen=True, kw_only=True):
    """An event of the run with the id `run`; `sequence` numbers the events of a run from 1 without gaps.

    `wall_time_ns` is in ns since 1970-01-01 UTC.
    """

    run: str
    sequence: int
    wall_time_ns: int
    event: Event

    @property
    def cell_time_s(self) -> float:
        """The time of the event in s of the cell's clock."""
        return self.event.time


Recorder: TypeAlias = Callable[[Envelope], None]


def make_run_id(task: str) -> str:
    """Return an id for a run of a task that no other run has, such as `clean_desk-20260131T120000Z-1f0c9a`."""
    name = "".join(letter if letter.isalnum() or letter in "_-" else "-" for letter in task)[:40].strip("-")
    return f"{name or 'task'}-{datetime.now(UTC):%Y%m%dT%H%M%SZ}-{token_hex(3)}"
