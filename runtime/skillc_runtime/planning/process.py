"""Runs external programs that may crash, hang, or exhaust memory or disk, and cleans up all they leave behind."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType
from typing import TypeAlias

import msgspec

from skillc_dsl.rendering.printable import printable
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.progress import Metronome
from skillc_runtime.platforms.memory import physical_bytes
from skillc_runtime.platforms.sandbox import NOT_STARTED, end_sandboxed, start_sandboxed

POLL_S = 0.005
"""The interval at which programs are polled."""

TAIL_BYTES = 2**16
"""How much of the end of a program's output is read: the whole may not fit into memory."""

LONGEST_LINE = 200
"""How many characters of a line of a program's output a message shows; a broken program may print no line ends."""

MOST_BYTES = 6 * 2**30
"""The most memory that a program may use, in bytes, however much there is."""

_PREFIX = "skillc-plan-"


class Limits(msgspec.Struct, frozen=True):
    """Limits of each process in bytes: its address space and the size of a file that it writes."""

    memory_bytes: int
    file_bytes: int


def quote_line(line: str) -> str:
    """Return a line of a program's output for a message: without control characters, LONGEST_LINE at most."""
    shown = printable(line.strip())
    return shown if len(shown) <= LONGEST_LINE else f"{shown[:LONGEST_LINE]}\N{HORIZONTAL ELLIPSIS}"


def make_workplace() -> TemporaryDirectory[str]:
    """Return a temporary folder for programs; it is removed after `with`, and also if this process is killed."""
    return TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True)


def _is_workplace(folder: Path) -> bool:
    return folder.name.startswith(_PREFIX)


def machine_limits() -> Limits:
    """Return limits that leave at least half of this machine's memory to other programs."""
    memory = physical_bytes()
    return Limits(memory_bytes=MOST_BYTES if memory is None else min(MOST_BYTES, memory // 2), file_bytes=2**30)


class ProcessEnded(msgspec.Struct, frozen=True):
    """The program ended; `code` is negative for a signal, `output` is the end of its output on both streams."""

    code: int
    output: str

    @property
    def last_line(self) -> str:
        """The last line of the output that is not empty, as a message can show it, or "nothing"."""
        return next((quote_line(line) for line in reversed(self.output.splitlines()) if line.strip()), "nothing")


class ProcessTimedOut(msgspec.Struct, frozen=True):
    """The program was stopped because it ran out of time; `output` is the end of its output until then."""

    output: str = ""


class ProcessNotStarted(msgspec.Struct, frozen=True):
    """The program could not be started; `why` is the reason."""

    why: str


ProcessResult: TypeAlias = ProcessEnded | ProcessTimedOut | ProcessNotStarted


class RunningProcess:
    """A program in a sandbox, which ends it and its descendants if this process dies.

    To be used in a `with` statement, after which neither the program nor a descendant runs.
    """

    def __init__(
        self,
        command: Sequence[str],
        folder: Path,
        output: str,
        limits: Limits,
        stdin: Path | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        """Start a program in a folder and write its output to the file `output` there; OSError if that fails."""
        self._output, self._was_stopped = folder / output, False
        most = limits.memory_bytes, limits.file_bytes
        with self._output.open("wb") as stdout, (stdin or Path(os.devnull)).open("rb") as source:
            self._process = start_sandboxed(command, folder, most, (source, stdout), environment, _is_workplace(folder))

    def __enter__(self) -> RunningProcess:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.stop()

    def stop(self) -> None:
        """End the program and all its descendants."""
        self._was_stopped = self._was_stopped or not self.has_ended
        end_sandboxed(self._process)

    @property
    def has_ended(self) -> bool:
        """Whether the program has ended, by itself or by `stop`."""
        return self._process.poll() is not None

    def outcome(self) -> ProcessResult:
        """Return how the program ended; ProcessTimedOut if it still runs or was stopped."""
        code = self._process.poll()
        output = _read_tail(self._output)
        if code is None or self._was_stopped:
            return ProcessTimedOut(output)
        ended = ProcessEnded(code, output)
        return ProcessNotStarted(ended.last_line) if code == NOT_STARTED else ended


def wait_for_end(
    programs: Sequence[RunningProcess], cancel: CancelToken, look: Callable[[], None] = lambda: None
) -> None:
    """Wait until a program has ended, or until `cancel` ends the wait; `look` is called at intervals."""
    metronome = Metronome()
    while not any(each.has_ended for each in programs) and cancel.reason is None:
        if metronome.is_due:
            look()
        time.sleep(POLL_S)


def _read_tail(file: Path) -> str:
    with file.open("rb") as output:
        output.seek(max(0, file.stat().st_size - TAIL_BYTES))
        return output.read().decode("utf-8", "replace")
