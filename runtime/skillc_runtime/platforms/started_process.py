"""A process, or a thread, that was started here, as whoever started it sees it."""

from __future__ import annotations

from typing import Protocol


class ProcessTerminated(BaseException):
    """Raised in a process that was asked to end, so that it cleans up."""


class StartedProcess(Protocol):
    """A process, or a thread, that was started here."""

    @property
    def pid(self) -> int:
        """The id of the process; of a thread, that of this process."""
        ...

    def poll(self) -> int | None:
        """Return the exit code, negative for a signal; None while it runs."""
        ...

    def terminate(self) -> None:
        """Ask it to end, if it still runs; a thread cannot be asked."""
        ...

    def kill(self) -> None:
        """End it, if it still runs; a thread goes on until its function returns."""
        ...
