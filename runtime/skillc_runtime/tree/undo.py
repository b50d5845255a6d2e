"""What scoped skills have set up and must be undone, whatever happens."""

from __future__ import annotations

from collections.abc import Callable

from skillc_runtime.tree.errors import describe_exception


class Undo:
    """A stack of things to undo; each is undone exactly once, the last first, also when another one raises."""

    def __init__(self) -> None:
        self._entries: list[Callable[[], None]] = []

    def push(self, undo: Callable[[], None]) -> None:
        """Add something to undo."""
        self._entries.append(undo)

    def run(self, undo: Callable[[], None]) -> str | None:
        """Undo one thing now if it is still to undo; return what went wrong."""
        if undo not in self._entries:
            return None
        self._entries.remove(undo)
        return _attempt(undo)

    def drop(self, undo: Callable[[], None]) -> None:
        """Take something off: there is nothing to undo."""
        if undo in self._entries:
            self._entries.remove(undo)

    def unwind(self) -> tuple[str, ...]:
        """Undo everything; return what went wrong, in the order in which it did."""
        problems: list[str] = []
        while self._entries:
            problem = _attempt(self._entries.pop())
            if problem is not None:
                problems.append(problem)
        return tuple(problems)


def _attempt(undo: Callable[[], None]) -> str | None:
    try:
        undo()
    except Exception as error:  # noqa: BLE001  the rest must be undone too; the caller reports
        return describe_exception(error)
    return None
