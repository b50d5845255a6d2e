"""Passes events to several listeners; one that fails is removed and never stops the robot."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_runtime.recording.events import Event, Listener


class Listeners:
    """A listener that passes events to others, in order; `problems` are the messages of those that failed."""

    def __init__(self, listeners: Sequence[Listener]) -> None:
        self._active = list(listeners)
        self.problems: list[str] = []

    def __call__(self, event: Event) -> None:
        for listener in tuple(self._active):
            try:
                listener(event)
            except Exception as error:  # noqa: BLE001  external code; the run must go on
                self._active.remove(listener)
                self.problems.append(f"{listener!r} was removed as a listener: {type(error).__name__}: {error}")
