"""The events of an operation as they happen, for loops that wait and for coroutines."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator, Callable, Iterator, Sequence

from skillc_runtime.recording.envelope import Envelope

LOOK_S = 0.1
ASYNC_LOOK_S = 0.01
"""How often a coroutine looks for further events, in s of wall time."""


class EventStream:
    """Events in order, each as an `Envelope` with its number; ends when the operation has ended."""

    def __init__(
        self, changed: threading.Condition, events: Sequence[Envelope], over: Callable[[], bool], after: int
    ) -> None:
        self._changed, self._events, self._over, self._after = changed, events, over, after

    def __iter__(self) -> Iterator[Envelope]:
        at = self._after
        while True:
            with self._changed:
                while at >= len(self._events) and not self._over():
                    self._changed.wait(LOOK_S)
                found = self._events[at:]
            if not found:
                return
            yield from found
            at += len(found)

    async def __aiter__(self) -> AsyncIterator[Envelope]:
        at = self._after
        while True:  # wait ends: with the run, whose events these are
            over = self._over()
            found = self._events[at:]
            for each in found:
                yield each
            at += len(found)
            if over and not found:
                return
            await asyncio.sleep(0.0 if found else ASYNC_LOOK_S)
