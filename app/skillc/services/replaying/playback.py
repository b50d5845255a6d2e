"""Plays the events of a recorded run in the time of its cell; nothing is computed, and nothing moves."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from skillc.errors import ServiceError
from skillc_runtime.execution.attempt import TICK_S
from skillc_runtime.execution.pace import Pace
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import NodeStarted, StateChanged, TaskEnded
from skillc_runtime.recording.states import State


@dataclass(slots=True)
class Playback:
    """A recorded run at the time `now` of its cell in s; `state` is the one that it had then, and `reason` why.

    `contact` is what became of a tool that pressed when it was paused.
    """

    events: Sequence[Envelope]
    now: float = 0.0
    state: State = "queued"
    reason: str = ""
    contact: ContactState = "none"
    _next: int = 0

    def __post_init__(self) -> None:
        if not self.events:
            raise ServiceError("the recording has no events to play")
        self.now = self.events[0].cell_time_s

    @property
    def ended(self) -> bool:
        """Whether all events have been played."""
        return self._next == len(self.events)

    def advance(self, seconds: float = TICK_S) -> Iterator[Envelope]:
        """Let the time of the cell pass, in s, and yield the events in it; not beyond the last event."""
        self.now = min(self.now + seconds, self.events[-1].cell_time_s)
        while not self.ended and self.events[self._next].cell_time_s <= self.now:
            yield self._take()

    def step(self) -> Iterator[Envelope]:
        """Yield the events up to the start of the next call, which it includes, or to the end."""
        while not self.ended:
            envelope = self._take()
            self.now = max(self.now, envelope.cell_time_s)
            yield envelope
            if isinstance(envelope.event, NodeStarted) and envelope.event.kind == "call":
                return

    def _take(self) -> Envelope:
        envelope = self.events[self._next]
        self._next += 1
        match envelope.event:
            case StateChanged(state=state, reason=reason, contact=contact):
                self.state, self.reason, self.contact = state, reason, contact
            case TaskEnded(status=state):
                self.state, self.reason, self.contact = state, "", "none"
            case _:
                pass
        return envelope


def play_paced(events: Sequence[Envelope], factor: float) -> Iterator[Envelope]:
    """Return an iterator over events in the time of the cell, `factor` times as fast as it went.

    ServiceError if there are none.
    """
    playback, pace = Playback(events), Pace(factor)

    def play() -> Iterator[Envelope]:
        while not playback.ended:
            time.sleep(pace.remaining_s(playback.now))
            yield from playback.advance()

    return play()
