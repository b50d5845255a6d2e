"""Passes values to several listeners; one that fails is removed and never stops the robot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

Value = TypeVar("Value")


class Listeners(Generic[Value]):
    """A listener that passes values to others, in order; `problems` are the messages of those that failed."""

    def __init__(self, listeners: Sequence[Callable[[Value], None]]) -> None:
        self._active = list(listeners)
        self.problems: list[str] = []

    def __call__(self, value: Value) -> None:
        for listener in tuple(self._active):
            try:
                listener(value)
            except Exception as error:  # noqa: BLE001  external code; the run must go on
                self._active.remove(listener)
                self.problems.append(f"{listener!r} was removed as a listener: {type(error).__name__}: {error}")
