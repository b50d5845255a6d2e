"""Reads single keys from the terminal while a program works, and leaves the terminal as it was."""

from __future__ import annotations

import os
import select
import signal
import sys
import termios
import time
from collections.abc import Callable
from types import FrameType

assert sys.platform != "win32", "it has no termios"

_SIGNALS = (signal.SIGTSTP, signal.SIGCONT)
_READ_BYTES = 64
_ESCAPE = b"\x1b"
_LOCAL_MODES = 3
"""The index of the local modes in what `tcgetattr` returns."""


class Keyboard:
    """Reads keys, without echo and without Enter, in a `with` statement in the main thread.

    While the program is suspended with Ctrl-Z, runs in the background, or has ended, the terminal is as it was.
    """

    def __init__(self, suspended: Callable[[], None], continued: Callable[[], None]) -> None:
        """Call `suspended` before the program is suspended with Ctrl-Z, and `continued` when it goes on."""
        self._suspended, self._continued = suspended, continued
        self._terminal = sys.stdin.fileno()
        self._process = os.getpid()
        self._before = termios.tcgetattr(self._terminal)
        self._handlers = {number: signal.getsignal(number) for number in _SIGNALS}
        self._gone = False

    def __enter__(self) -> Keyboard:
        self._handle(signal.SIGTSTP, self._suspend)
        self._handle(signal.SIGCONT, self._continue)
        self._take()
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        self._give_back()

    def read(self, seconds: float) -> str:
        """Wait for up to `seconds` for keys; return them, empty if none. Those with escape codes are dropped."""
        if self._gone or not self._is_in_foreground():
            time.sleep(seconds)
            return ""
        if not select.select([self._terminal], [], [], seconds)[0]:
            return ""
        try:
            typed = os.read(self._terminal, _READ_BYTES)
        except OSError:  # the terminal was closed
            typed = b""
        self._gone = not typed
        return "" if typed.startswith(_ESCAPE) else typed.decode(errors="ignore")

    def _handle(self, number: signal.Signals, handler: Callable[[int, FrameType | None], None]) -> None:
        if self._handlers[number] is not signal.SIG_IGN:
            signal.signal(number, handler)

    def _suspend(self, number: int, _frame: FrameType | None) -> None:
        """Give the terminal back and suspend the program; go on when it is continued."""
        ours = os.getpid() == self._process  # not so in a process that was forked
        if ours:
            self._give_back()
            self._suspended()
        signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
        signal.signal(number, self._suspend)

    def _continue(self, _number: int, _frame: FrameType | None) -> None:
        if os.getpid() == self._process and self._is_in_foreground():
            self._take()
            self._continued()

    def _is_in_foreground(self) -> bool:
        try:
            return os.tcgetpgrp(self._terminal) == os.getpgrp()
        except OSError:
            return False

    def _take(self) -> None:
        modes = termios.tcgetattr(self._terminal)
        modes[_LOCAL_MODES] &= ~(termios.ICANON | termios.ECHO)
        self._set(modes)

    def _give_back(self) -> None:
        self._set(self._before)

    def _set(self, modes: list[int | list[bytes | int]]) -> None:
        """Set the modes of the terminal, unless another program has it: that would suspend this one."""
        if self._is_in_foreground():
            try:
                termios.tcsetattr(self._terminal, termios.TCSANOW, modes)
            except termios.error:
                self._gone = True
