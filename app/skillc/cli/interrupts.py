"""Lets a command that a signal ends clean up first: programs that it started, temporary files, locks."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from skillc_runtime.platforms.signals import handling

SHELL_OFFSET = 128
"""Shells give a process that was ended by a signal this exit code plus the signal's number."""


class Interrupted(KeyboardInterrupt):
    """A signal asks the program to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number

    @property
    def exit_code(self) -> int:
        """The exit code that shells give to a process that the signal ended."""
        return SHELL_OFFSET + self.number

    def __str__(self) -> str:
        return "interrupted" if self.number == signal.SIGINT else f"ended by {signal.Signals(self.number).name}"


@contextmanager
def raising_on_signals() -> Iterator[None]:
    """Raise Interrupted in the main thread at the first signal that asks the program to end; exit at the second one.

    That holds until the program has ended. Signals that are ignored stay ignored, as `nohup` wants it. In other
    threads this does nothing.
    """
    received = False

    def handle(number: int, _frame: FrameType | None) -> None:
        nonlocal received
        if received:
            os._exit(SHELL_OFFSET + number)
        received = True
        raise Interrupted(number)

    with handling(handle, lambda: received):
        yield


@contextmanager
def noting_signals() -> Iterator[Callable[[], Interrupted | None]]:
    """Note the first signal that asks the program to end: the value returns it. Raise it at the second one.

    At the third one, exit. To be used inside of `raising_on_signals`, by a program that looks often.
    """
    noted: list[Interrupted] = []

    def handle(number: int, _frame: FrameType | None) -> None:
        noted.append(Interrupted(number))
        if len(noted) > 2:
            os._exit(SHELL_OFFSET + number)
        if len(noted) == 2:
            raise noted[1]

    with handling(handle):
        yield lambda: noted[0] if noted else None
