"""The stack of undo functions of scoped skills, called when the scope ends for any reason."""

from __future__ import annotations

from collections.abc import Callable

from skillc_runtime.execution.tree.errors import describe_exception
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS


class UndoStack:
    """A stack of undo functions; each is called exactly once, the last first, even if others raise."""

    def __init__(self) -> None:
        self._entries: list[Callable[[], None]] = []

    def push(self, undo: Callable[[], None]) -> None:
        """Add an entry."""
        self._entries.append(undo)

    def undo_one(self, undo: Callable[[], None]) -> str | None:
        """Call one entry now, if it is still on the stack, and remove it; return its error message, if any."""
        if undo not in self._entries:
            return None
        self._entries.remove(undo)
        return _try_undo(undo)

    def discard(self, undo: Callable[[], None]) -> None:
        """Remove an entry without calling it."""
        if undo in self._entries:
            self._entries.remove(undo)

    def unwind(self) -> tuple[str, ...]:
        """Call and remove all entries, the last first; return the error messages in that order."""
        problems: list[str] = []
        while self._entries:
            problem = _try_undo(self._entries.pop())
            if problem is not None:
                problems.append(problem)
        return tuple(problems)


def _try_undo(undo: Callable[[], None]) -> str | None:
    try:
        undo()
    except FOREIGN_ERRORS as error:  # the other entries must be undone too; the caller reports
        return describe_exception(error)
    return None
