"""Small programs that behave badly, in the place of planners, and what they leave behind."""

from __future__ import annotations

import stat
import sys
import time
from pathlib import Path

from skillc_runtime.planning.process import Limits
from waiting import LONG_S

SMALL = Limits(memory_bytes=256 * 2**20, file_bytes=2**20)
"""So much memory is enough for a shell or for Python, but not for a hog."""

HANG = "sleep 600 & echo $! > {pids}/$$; echo $$ >> {pids}/$$; wait"
CRASH = "kill -SEGV $$"
GARBAGE = "head -c 100000 /dev/urandom"
LONG_LINE = "head -c 100000 /dev/zero | tr '\\0' x"
ENDLESS = "yes '(fly to the moon)'"
FILL = "yes > big"
HOG = f"exec {sys.executable} -c 'x = bytearray(2**30)'"


def program(folder: Path, name: str, script: str) -> str:
    """Write a shell script and return its path; `{pids}` in it is a folder for process numbers."""
    pids = folder / "pids"
    pids.mkdir(exist_ok=True)
    path = folder / name
    path.write_text(f"#!/bin/sh\n{script.replace('{pids}', str(pids))}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


def started(folder: Path) -> tuple[int, ...]:
    """Return the numbers of the processes that the programs of a folder wrote down."""
    return tuple(int(line) for file in sorted((folder / "pids").iterdir()) for line in file.read_text().split())


def ends(pid: int) -> bool:
    """Whether a process ends; one that only waits to be reaped has ended."""
    end = time.monotonic() + LONG_S
    while time.monotonic() < end:
        try:
            if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except (FileNotFoundError, ProcessLookupError):
            return True
        time.sleep(0.05)
    return False
