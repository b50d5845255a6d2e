"""The side of the run: starts the watchdog process, counts ticks, and says when the run has ended."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from math import inf
from pathlib import Path

import msgspec

from skillc.services.errors import ServiceError
from skillc.services.watchdog import program
from skillc.services.watchdog.compilation import watching_compilation
from skillc.services.watchdog.ending import DESCRIPTION, RunDescription
from skillc.services.watchdog.program import SharedState

TICK_TIMEOUT_S = 30.0
"""How long a tick may take by default, in s of wall time."""

CLOSE_S = 5.0
"""How long the watchdog may take to end once the run has ended."""


@contextmanager
def watching(folder: Path, run: RunDescription, state: SharedState) -> Iterator[None]:
    """Watch this process, which carries out a run, in a `with` statement; `state`, in `folder`, counts its ticks.

    If a tick takes longer than the run's time-out, or if this process dies, the watchdog ends this process with exit
    code 3, writes the end of the run, and removes `folder`, which is for the use of both. Functions may be compiled for
    as long as it takes. A time-out of 0 lets ticks take any time. ServiceError if the watchdog cannot be started.
    """
    process = _start(folder, run)
    try:
        with _exiting_at_sigquit(), watching_compilation(state.add_busy):
            yield
    finally:
        _dismiss(process)


def _start(folder: Path, run: RunDescription) -> subprocess.Popen[bytes]:
    paths = os.pathsep.join(str(Path(path).absolute()) for path in sys.path if path)
    try:
        (folder / DESCRIPTION).write_bytes(msgspec.json.encode(run))
        return subprocess.Popen(
            (sys.executable, "-I", "-S", program.__file__, str(os.getpid()), str(folder), str(run.timeout_s or inf)),
            stdin=subprocess.PIPE,
            stdout=None if run.prints_json else subprocess.DEVNULL,
            start_new_session=True,
            env={**os.environ, "PYTHONPATH": paths},
        )
    except OSError as error:
        raise ServiceError(f"the watchdog process cannot be started: {error.strerror or error}") from error


@contextmanager
def _exiting_at_sigquit() -> Iterator[None]:
    """Make `_exit` of the C library the handler of SIGQUIT, so that it works while the interpreter is blocked.

    The handler is called with the number of the signal, which is 3, the exit code of a failed task.
    """
    c = ctypes.CDLL(None)
    c.signal.restype, c.signal.argtypes = ctypes.c_void_p, (ctypes.c_int, ctypes.c_void_p)
    before = c.signal(signal.SIGQUIT, ctypes.cast(c._exit, ctypes.c_void_p))
    try:
        yield
    finally:
        c.signal(signal.SIGQUIT, before)


def _dismiss(process: subprocess.Popen[bytes]) -> None:
    """Tell the watchdog that the run has ended, and wait for its end."""
    assert process.stdin is not None, "started with a pipe"
    with contextlib.suppress(OSError):
        process.stdin.write(b"e")
        process.stdin.close()
    try:
        process.wait(CLOSE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait(CLOSE_S)
