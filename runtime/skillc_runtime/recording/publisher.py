"""Numbers the events of a run and passes them to recorders as envelopes."""

from __future__ import annotations

import time
from collections.abc import Sequence

from skillc_runtime.recording.envelope import Envelope, Recorder
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.listeners import Listeners


class Publisher:
    """A listener that passes each event of the run with the id `run` to recorders, numbered from 1 without gaps."""

    def __init__(self, run: str, recorders: Sequence[Recorder]) -> None:
        self.run = run
        self.sequence = 0
        self._recorders = Listeners(recorders)

    @property
    def problems(self) -> tuple[str, ...]:
        """The errors raised by recorders, which then were removed."""
        return tuple(self._recorders.problems)

    def __call__(self, event: Event) -> None:
        self.sequence += 1
        self._recorders(Envelope(run=self.run, sequence=self.sequence, wall_time_ns=time.time_ns(), event=event))
