"""A view of an object that several threads may use: one call at a time."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Any, TypeVar, cast

T = TypeVar("T")


def locked(target: T, lock: AbstractContextManager[object], parts: tuple[str, ...] = ()) -> T:
    """Return a view whose methods and properties hold `lock` while they run; so do those of the attributes `parts`."""
    return cast("T", _LockedView(target, lock, parts))


class _LockedView:
    """Passes everything on to an object."""

    def __init__(self, target: object, lock: AbstractContextManager[object], parts: tuple[str, ...]) -> None:
        self._target, self._lock = target, lock
        for part in parts:
            setattr(self, part, _LockedView(getattr(target, part), lock, ()))

    def __getattr__(self, name: str) -> Any:
        with self._lock:
            value = getattr(self._target, name)
        if not callable(value):
            return value

        def call(*arguments: Any, **named: Any) -> Any:
            with self._lock:
                return value(*arguments, **named)

        return call
