"""A small program that watches the process of a run, and ends it if its ticks stop.

It is started as a file, without the package: `python -I -S watchdog_program.py PARENT FOLDER TIMEOUT ENDING`. PARENT
is the id of the run's process, FOLDER has the shared memory (STATE) and the description of the run, TIMEOUT is in s. A
byte on standard input says that the run has ended properly. Otherwise, once the run's process is gone,
`-m ENDING FOLDER REASON` writes the end of the run; PYTHONPATH says where that module is.
"""

from __future__ import annotations

import contextlib
import mmap
import os
import select
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

STATE = "state"
POLL_S = 0.1
MAX_POLL_S = 1.0
"""The greatest time between two polls that counts: more passes if the machine, or this program, was suspended."""

STOP_S = 2.0
"""How long devices may take to stop before the process that controls them is ended."""

QUIT_S = 2.0
"""How long the run's process may take to end by SIGQUIT before it is killed."""

ENDING_S = 60.0
"""How long writing the end may take."""

_TICKS, _ARMED, _BUSY, _STOP, _NOW, _WORDS = 0, 1, 2, 3, 4, 8


class SharedState:
    """The memory that a run and its watchdog share: a file with eight words of 8 bytes.

    The run counts its ticks, with the time of its cell. The watchdog requests a stop before it ends the run; a control
    thread reads that in every period.
    """

    def __init__(self, path: Path) -> None:
        """Map a file, which is created if it does not exist."""
        with path.open("ab") as file:
            file.truncate(8 * _WORDS)
        with path.open("r+b") as file:
            memory = memoryview(mmap.mmap(file.fileno(), 8 * _WORDS))
        self._words, self._numbers = memory.cast("q"), memory.cast("d")

    @property
    def ticks(self) -> int:
        """How many ticks were counted."""
        return self._words[_TICKS]

    @property
    def now(self) -> float:
        """The time of the cell at the last tick, in s."""
        return self._numbers[_NOW]

    @property
    def is_awaiting_tick(self) -> bool:
        """Whether the next tick is due soon."""
        return bool(self._words[_ARMED]) and not self._words[_BUSY]

    @property
    def is_stop_requested(self) -> bool:
        """Whether all devices must stop."""
        return bool(self._words[_STOP])

    def count_tick(self, now: float) -> None:
        """Count a tick at the time `now` of the cell in s, and await the next one."""
        self._numbers[_NOW] = now
        self._words[_TICKS] += 1
        self._words[_ARMED] = 1

    def disarm(self) -> None:
        """Await no tick."""
        self._words[_ARMED] = 0

    def add_busy(self, count: int) -> None:
        """Add a reason (1) for which a tick may take long, or remove one (-1)."""
        self._words[_BUSY] += count

    def request_stop(self) -> None:
        """Let all devices stop."""
        self._words[_STOP] = 1


def main(parent: int, folder: Path, timeout_s: float, ending: str) -> None:
    """Watch until the run ends; end it and write its end, by a module, if it does not do so itself."""
    if sys.platform == "win32":
        raise RuntimeError("Windows has no such signals")
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, signal.SIG_IGN)
    state = SharedState(folder / STATE)
    reason = _watch(parent, state, timeout_s)
    if reason == "blocked":
        state.request_stop()
        time.sleep(STOP_S)
        _restore_terminal(parent)
        _end(parent)
    if reason is not None:
        _write_end(folder, reason, ending)


def _watch(parent: int, state: SharedState, timeout_s: float) -> str | None:
    """Return "died" or "blocked"; None if the run has ended properly."""
    silent_s, ticks, before = 0.0, -1, time.monotonic()
    while True:
        said = _read_message()
        if said:
            return None
        if said == b"" or os.getppid() != parent:
            return "died"
        now = time.monotonic()
        if state.is_awaiting_tick and state.ticks == ticks and not _is_suspended(parent):
            silent_s += min(now - before, MAX_POLL_S)
        else:
            silent_s, ticks = 0.0, state.ticks
        before = now
        if silent_s > timeout_s:
            return "blocked"


def _read_message() -> bytes | None:
    """Wait for POLL_S; return what the run said, empty if it can say nothing any more, None if it said nothing."""
    ready, _, _ = select.select([0], [], [], POLL_S)
    return os.read(0, 1) if ready else None


def _is_suspended(pid: int) -> bool:
    """Whether a process is stopped, for example by Ctrl-Z; False on systems without /proc."""
    return _read_status(pid)[:1] in (["T"], ["t"])


def _read_status(pid: int) -> list[str]:
    """Return state, parent, process group, session, terminal, its foreground group, ...; empty without /proc."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return []


def _restore_terminal(pid: int) -> None:
    """Let the terminal show what is typed again if a process has it, which reads single keys."""
    if sys.platform == "win32":
        return
    import termios

    status = _read_status(pid)
    if not status or status[2] != status[5]:
        return
    with contextlib.suppress(termios.error):
        modes = termios.tcgetattr(sys.stderr)
        modes[3] |= termios.ICANON | termios.ECHO
        termios.tcsetattr(sys.stderr, termios.TCSANOW, modes)


def _end(parent: int) -> None:
    """End the run's process: by SIGQUIT, whose handler in it is `_exit`, or else by SIGKILL."""
    if sys.platform == "win32":
        return
    for number in (signal.SIGQUIT, signal.SIGKILL):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if os.getppid() == parent:
                os.kill(parent, number)
        if _wait_until(lambda: os.getppid() != parent, QUIT_S):
            return


def _wait_until(condition: Callable[[], bool], seconds: float) -> bool:
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return condition()


def _write_end(folder: Path, reason: str, ending: str) -> None:
    with contextlib.suppress(OSError, subprocess.TimeoutExpired):
        command = (sys.executable, "-P", "-m", ending, str(folder), reason)
        subprocess.run(command, stdin=subprocess.DEVNULL, timeout=ENDING_S, check=False)
    shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]), sys.argv[4])
