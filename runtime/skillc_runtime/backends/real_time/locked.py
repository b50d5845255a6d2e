"""A view of an object that several threads may use: one call at a time, and nobody waits for his turn for ever."""

from __future__ import annotations

from threading import RLock
from typing import Any, TypeVar, cast

from skillc_runtime.devices.backend import BackendBroken

LOCK_S = 60.0
"""How long a thread waits for the end of what another one does, in s of wall time."""

DRIVER_PARTS = ("measured", "motion", "compliance")
"""The parts of the driver of an arm."""

T = TypeVar("T")


class CellLock:
    """Lets one thread at a time use a cell, as often as it wants; BackendBroken if it does not end within LOCK_S."""

    def __init__(self) -> None:
        self._lock = RLock()

    def __enter__(self) -> None:
        if not self._lock.acquire(timeout=LOCK_S):
            raise BackendBroken(f"a call or a control period has taken more than {LOCK_S:g} s")

    def __exit__(self, *_: object) -> None:
        self._lock.release()


def locked(target: T, lock: CellLock, parts: tuple[str, ...] = ()) -> T:
    """Return a view whose methods and properties hold `lock` while they run; so do those of the attributes `parts`."""
    return cast("T", _LockedView(target, lock, parts))


class _LockedView:
    """Passes everything on to an object."""

    def __init__(self, target: object, lock: CellLock, parts: tuple[str, ...]) -> None:
        self._target, self._turn = target, lock
        for part in parts:
            setattr(self, part, _LockedView(getattr(target, part), lock, ()))

    def __getattr__(self, name: str) -> Any:
        with self._turn:
            value = getattr(self._target, name)
        if not callable(value):
            return value

        def call(*arguments: Any, **named: Any) -> Any:
            with self._turn:
                return value(*arguments, **named)

        return call
