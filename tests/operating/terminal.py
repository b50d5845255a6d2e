"""A terminal in which a test runs a program, types keys and reads what is shown."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pyte
from pyte.screens import Char

from waiting import LONG_S

ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|\r")
ROWS, COLUMNS = 30, 110


Line = tuple[Char, ...]
"""A line of a terminal, a character for each column."""


def text_of(line: Line) -> str:
    """Return the text of a line, without the blanks at its end."""
    return "".join(each.data for each in line).rstrip()


class Terminal:
    """Runs a program in a new terminal, in a `with` statement; `shown` is all that was shown, without escape codes."""

    def __init__(
        self, command: Sequence[str], environment: dict[str, str], columns: int = COLUMNS, folder: Path | None = None
    ) -> None:
        self._columns = columns
        self._master, self._slave = pty.openpty()
        fcntl.ioctl(self._master, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS, columns, 0, 0))
        self.modes_before = self.modes
        self._raw, self._read = b"", 0
        self._process = subprocess.Popen(
            command,
            stdin=self._slave,
            stdout=self._slave,
            stderr=self._slave,
            env={**environment, "TERM": "xterm"},
            cwd=folder,
            preexec_fn=self._control,
        )

    def __enter__(self) -> Terminal:
        return self

    def __exit__(self, *_: object) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        os.close(self._master)
        os.close(self._slave)

    @property
    def modes(self) -> list[Any]:
        """The modes of the terminal."""
        return termios.tcgetattr(self._slave)

    @property
    def echoes(self) -> bool:
        """Whether the terminal shows what is typed, as it does unless a program reads single keys."""
        return bool(self.modes[3] & termios.ECHO)

    @property
    def shown(self) -> str:
        """Everything that was shown."""
        return ESCAPES.sub("", self._raw.decode(errors="replace"))

    @property
    def lines(self) -> list[Line]:
        """The lines that remain, as the user of the terminal can scroll through them, without empty ones at the end.

        The screen is wider than programs are told, so a line that is too wide for it is longer than `columns`.
        """
        width = 2 * self._columns
        screen = pyte.HistoryScreen(width, ROWS, history=10_000, ratio=1.0)
        pyte.ByteStream(screen).feed(self._raw)
        rows = [*screen.history.top, *(screen.buffer[row] for row in range(ROWS))]
        lines = [tuple(row[column] for column in range(width)) for row in rows]
        while lines and not text_of(lines[-1]):
            lines.pop()
        return lines

    def type(self, keys: str) -> None:
        """Type keys."""
        self._read = len(self.shown)
        os.write(self._master, keys.encode())

    def expect(self, pattern: str) -> re.Match[str]:
        """Wait until what has been shown since the last keys has a match of a pattern; return it."""
        end = time.monotonic() + LONG_S
        while (found := re.search(pattern, self.shown[self._read :], re.DOTALL)) is None:
            assert time.monotonic() < end, f"{pattern!r} is not shown: {self.shown[-800:]}"
            self._receive()
        return found

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the program."""
        os.kill(self._process.pid, number)

    def wait(self) -> int:
        """Wait for the end of the program; return its exit code."""
        end = time.monotonic() + LONG_S
        while self._process.poll() is None:
            assert time.monotonic() < end, f"it does not end: {self.shown[-800:]}"
            self._receive()
        self._receive()
        return self._process.returncode

    def _receive(self) -> None:
        while select.select([self._master], [], [], 0.05)[0]:
            self._raw += os.read(self._master, 2**16)

    def _control(self) -> None:
        """Make the terminal that of the new process; runs in it."""
        os.setsid()
        fcntl.ioctl(self._slave, termios.TIOCSCTTY, 0)
