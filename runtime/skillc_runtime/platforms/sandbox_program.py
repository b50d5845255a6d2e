"""A small program that runs a command within limits, and ends all its descendants when it or the parent process ends.

It is started as a file, without the package: `python -I -S sandbox_program.py PARENT MEMORY FILE FOLDER COMMAND ..`.
PARENT is the id of the process to watch, MEMORY and FILE are the limits of address space and file size in bytes,
FOLDER is removed if the parent is gone; it may be empty. The program ends as the command did, by the same signal or
with the same code, or with NOT_STARTED and the reason as its last line.
"""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from types import FrameType

assert sys.platform != "win32", "it has no limits of processes"

NOT_STARTED = 127
POLL_S = 0.1
"""The interval at which it is checked whether the parent still runs."""

_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36


def main(parent: int, memory: int, file: int, folder: str, command: list[str]) -> None:
    """Run the command; does not return."""
    _stop_when_orphaned(parent, folder)
    if sys.platform == "linux":
        _prctl(_PR_SET_CHILD_SUBREAPER, 1)
    pid = os.fork()
    if not pid:
        _exec(command, memory, file)
    _, status = os.waitpid(pid, 0)  # wait ends: with the command, or when this process is told to stop
    _end_descendants()
    _end_like(status)


def _stop_when_orphaned(parent: int, folder: str) -> None:
    def check_parent(_number: int, _frame: FrameType | None) -> None:
        if os.getppid() != parent:
            _end_descendants()
            if folder:
                _remove(folder)
            _stop(_number, _frame)

    signal.signal(signal.SIGTERM, _stop)
    signal.signal(signal.SIGALRM, check_parent)
    signal.setitimer(signal.ITIMER_REAL, POLL_S, POLL_S)


def _stop(_number: int, _frame: FrameType | None) -> None:
    _end_descendants()
    os.killpg(0, signal.SIGKILL)


def _remove(folder: str) -> None:
    import shutil

    shutil.rmtree(folder, ignore_errors=True)


def _exec(command: list[str], memory: int, file: int) -> None:
    """Replace this process by the command; the kernel ends the command if the sandbox is killed."""
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    for number in (signal.SIGTERM, signal.SIGALRM):
        signal.signal(number, signal.SIG_DFL)
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python ignores it, and ignored signals stay ignored after exec
    _set_limit(resource.RLIMIT_AS, memory)
    _set_limit(resource.RLIMIT_FSIZE, file)
    _set_limit(resource.RLIMIT_CORE, 0)
    if sys.platform == "linux":
        _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    try:
        os.execvp(command[0], command)
    except OSError as error:
        os.write(2, f"{command[0]}: {error.strerror}\n".encode())
        os._exit(NOT_STARTED)


def _set_limit(kind: int, maximum: int) -> None:
    _, hard = resource.getrlimit(kind)
    maximum = maximum if hard == resource.RLIM_INFINITY else min(maximum, hard)
    with contextlib.suppress(OSError, ValueError):  # a system without this limit
        resource.setrlimit(kind, (maximum, maximum))


def _prctl(option: int, value: int) -> None:
    import ctypes

    ctypes.CDLL(None).prctl(option, value, 0, 0, 0)


def _end_descendants() -> None:
    """Kill all children until there are none; this process is a subreaper and adopts the orphans of those that end."""
    while children := tuple(_children()):
        for pid in children:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
            with contextlib.suppress(ChildProcessError):
                os.waitpid(pid, 0)  # wait ends: at once, since the process was killed


def _children() -> Iterator[int]:
    """Yield the ids of this process's children, on systems with /proc."""
    own = str(os.getpid())
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            _state, parent, *_ = (folder / "stat").read_text().rpartition(")")[2].split()
            if parent == own:
                yield int(folder.name)


def _end_like(status: int) -> None:
    """End this process with the exit code or the signal of a wait status."""
    code = os.waitstatus_to_exitcode(status)
    if code < 0:
        signal.signal(signal.SIGALRM, signal.SIG_IGN)
        _set_limit(resource.RLIMIT_CORE, 0)
        with contextlib.suppress(OSError):
            signal.signal(-code, signal.SIG_DFL)  # signals that cannot be caught need no handler
        os.kill(os.getpid(), -code)
    os._exit(code)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4], sys.argv[5:])
