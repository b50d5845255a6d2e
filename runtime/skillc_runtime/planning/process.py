"""Runs a foreign program that may crash, hang or eat all memory, and leaves nothing of it behind."""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

MEMORY_BYTES = 6 * 2**30
TAIL = 2000


@dataclass(frozen=True, slots=True)
class Ended:
    """The program ended; `code` is negative for a signal, `output` is all it said on both streams."""

    code: int
    output: str

    @property
    def last_line(self) -> str:
        """The last thing it said."""
        return next((line.strip() for line in reversed(self.output[-TAIL:].splitlines()) if line.strip()), "nothing")


@dataclass(frozen=True, slots=True)
class OutOfTime:
    """The program was stopped because its time was up."""


@dataclass(frozen=True, slots=True)
class NotStarted:
    """The program could not be started, and why."""

    why: str


Run: TypeAlias = Ended | OutOfTime | NotStarted


def run(command: Sequence[str], folder: Path, seconds: float, stdin: Path | None = None) -> Run:
    """Run a program in a folder, in a session of its own; whatever it started is killed when it ends or time is up."""
    said = folder / "said.txt"
    with said.open("wb") as output, (stdin or Path(os.devnull)).open("rb") as source:
        try:
            process = subprocess.Popen(
                command, cwd=folder, stdin=source, stdout=output, stderr=subprocess.STDOUT, start_new_session=True
            )
        except OSError as error:
            return NotStarted(f"{command[0]}: {error.strerror}")
        try:
            _limit_memory(process.pid)
            process.wait(max(seconds, 0.0))
        except subprocess.TimeoutExpired:
            return OutOfTime()
        finally:
            _kill_group(process)
    return Ended(process.returncode, said.read_bytes().decode("utf-8", "replace"))


def _limit_memory(pid: int) -> None:
    if hasattr(resource, "prlimit"):
        with contextlib.suppress(ProcessLookupError, PermissionError):
            resource.prlimit(pid, resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))


def _kill_group(process: subprocess.Popen[bytes]) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
