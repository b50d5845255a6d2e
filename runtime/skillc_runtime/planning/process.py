"""Runs foreign programs that may crash, hang, eat all memory or fill the disk, and leaves nothing of them behind."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType
from typing import TypeAlias

from skillc_runtime.planning import process_sandbox

LOOK_S = 0.005
"""How often is looked whether a program has ended."""

SWEEP_S = 1.0
"""How long the sandbox gets to end what the program started, before it is killed with the program."""

TAIL_BYTES = 2**16
"""So much of what a program says is read; it may say more than memory holds."""

_PREFIX = "skillc-plan-"


@dataclass(frozen=True, slots=True)
class Limits:
    """The most address space that each process may have and the most that it may write into one file, in bytes."""

    memory_bytes: int
    file_bytes: int


def make_workplace() -> TemporaryDirectory[str]:
    """Return a temporary folder for programs, which is removed after a `with`; also when this process is killed."""
    return TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True)


def _is_workplace(folder: Path) -> bool:
    return folder.name.startswith(_PREFIX)


def machine_limits() -> Limits:
    """Return the limits that leave half of this machine's memory to others."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return Limits(memory_bytes=min(6 * 2**30, memory // 2), file_bytes=2**30)


@dataclass(frozen=True, slots=True)
class ProcessEnded:
    """The program ended; `code` is negative for a signal, `output` is the end of what it said on both streams."""

    code: int
    output: str

    @property
    def last_line(self) -> str:
        """The last thing it said."""
        return next((line.strip() for line in reversed(self.output.splitlines()) if line.strip()), "nothing")


@dataclass(frozen=True, slots=True)
class ProcessTimedOut:
    """The program was stopped because its time was up; `output` is the end of what it had said."""

    output: str = ""


@dataclass(frozen=True, slots=True)
class ProcessNotStarted:
    """The program could not be started, and why."""

    why: str


Run: TypeAlias = ProcessEnded | ProcessTimedOut | ProcessNotStarted


class RunningProcess:
    """A program that runs in a sandbox, which ends it and all it started when this process dies.

    Used in a `with` statement, after which nothing of the program runs any more.
    """

    def __init__(
        self,
        command: Sequence[str],
        folder: Path,
        said: str,
        limits: Limits,
        stdin: Path | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        """Start a program in a folder; it talks into the file `said` there. OSError when the folder is not usable."""
        self._said, self._cut_short = folder / said, False
        sandboxed = (sys.executable, "-I", "-S", process_sandbox.__file__, str(os.getpid()))
        limited = (str(limits.memory_bytes), str(limits.file_bytes), str(folder) if _is_workplace(folder) else "")
        with self._said.open("wb") as output, (stdin or Path(os.devnull)).open("rb") as source:
            self._process = subprocess.Popen(
                (*sandboxed, *limited, *command),
                cwd=folder,
                stdin=source,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                env=None if environment is None else {**os.environ, **environment},
            )

    def __enter__(self) -> RunningProcess:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.stop()

    def stop(self) -> None:
        """End the program and all it started."""
        if self._process.poll() is None:
            self._cut_short = True
            self._process.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(SWEEP_S)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()

    @property
    def ended(self) -> bool:
        """Whether the program has ended by itself, or was stopped."""
        return self._process.poll() is not None

    def outcome(self) -> Run:
        """Return how the program ended; OutOfTime where it still runs or was stopped."""
        code = self._process.poll()
        output = _tail(self._said)
        if code is None or self._cut_short:
            return ProcessTimedOut(output)
        ended = ProcessEnded(code, output)
        return ProcessNotStarted(ended.last_line) if code == process_sandbox.NOT_STARTED else ended


def run_program(command: Sequence[str], folder: Path, seconds: float, stdin: Path | None = None) -> Run:
    """Run a program in a folder; whatever it started is killed when it ends or its time is up."""
    with RunningProcess(command, folder, "said.txt", machine_limits(), stdin) as running:
        wait_for_end((running,), time.monotonic() + seconds)
        return running.outcome()


def wait_for_end(programs: Sequence[RunningProcess], end: float) -> None:
    """Wait until a program has ended, or until the monotonic clock says `end`."""
    while not any(each.ended for each in programs) and time.monotonic() < end:
        time.sleep(LOOK_S)


def _tail(file: Path) -> str:
    with file.open("rb") as said:
        said.seek(max(0, file.stat().st_size - TAIL_BYTES))
        return said.read().decode("utf-8", "replace")
