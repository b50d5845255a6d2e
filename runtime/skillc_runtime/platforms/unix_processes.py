"""Starts processes that run a function: a fork, which shares everything with this process, or a new interpreter.

A process that is started here leaves the signals of the terminal to its parent, cleans up when it is terminated, and
ends when its parent does.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from types import FrameType
from typing import NoReturn, TextIO

from skillc_dsl.garbage import exempt_for_ever
from skillc_ontology import catalogue
from skillc_runtime.platforms.signals import ENDING
from skillc_runtime.platforms.started_process import ProcessTerminated, StartedProcess

assert sys.platform != "win32", "there are no forks"

PARENT_POLL_S = 0.1
"""The interval at which a process checks whether its parent still runs."""
_SPAWNED = """
import pickle, sys
sys.path[:] = pickle.load(sys.stdin.buffer)
from skillc_dsl.importing import importing
from skillc_runtime.platforms.python_modules import defer_import
defer_import("glfw")
with importing():
    function = pickle.load(sys.stdin.buffer)
function()
"""


class _Forked:
    """A forked process."""

    def __init__(self, pid: int) -> None:
        self.pid = pid
        self._code: int | None = None

    def poll(self) -> int | None:
        if self._code is None:
            try:
                pid, status = os.waitpid(self.pid, os.WNOHANG)
            except ChildProcessError:  # this process ignores the ends of its children
                self._code = 0
            else:
                self._code = os.waitstatus_to_exitcode(status) if pid else None
        return self._code

    def terminate(self) -> None:
        self._send(signal.SIGTERM)

    def kill(self) -> None:
        self._send(signal.SIGKILL)

    def _send(self, number: signal.Signals) -> None:
        if self.poll() is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)


def fork(function: Callable[[], None]) -> StartedProcess:
    """Run a function in a fork."""
    parent = os.getpid()
    with _signals_blocked(), warnings.catch_warnings():
        # Other threads may hold locks at this moment; the new process takes none of theirs.
        warnings.filterwarnings("ignore", r"This process .* is multi-threaded", DeprecationWarning)
        pid = os.fork()
        if pid == 0:
            _run_forked(function, parent)
    return _Forked(pid)


def _run_forked(function: Callable[[], None], parent: int) -> NoReturn:
    """Run the function in a fork, which must not destroy what it shares with its parent.

    Objects of the parent are never collected, so that no destructor of a store, a socket or a temporary folder runs.
    Output that the parent has buffered is never written, because the streams are new.
    """
    try:
        exempt_for_ever()
        inherited = sys.stdout, sys.stderr
        sys.stdout, sys.stderr = _open_stream(1), _open_stream(2)
        _run(function, parent)
        del inherited
    finally:
        os._exit(1)


def _open_stream(number: int) -> TextIO:
    try:
        return os.fdopen(number, "w", encoding="utf-8", errors="replace", closefd=False)
    except OSError:  # this process has no such stream
        return Path(os.devnull).open("w", encoding="utf-8")


def spawn(function: Callable[[], None], files: Sequence[int]) -> StartedProcess:
    """Run the function in a new interpreter; what it imports is found on the same path as here."""
    with tempfile.TemporaryFile() as request:
        pickle.dump(sys.path, request)
        pickle.dump(partial(_run, function, os.getpid()), request)
        request.seek(0)
        with _signals_blocked():
            command = (sys.executable, "-c", _SPAWNED)
            return subprocess.Popen(command, stdin=request, pass_fds=files, env=catalogue.make_environment())


@contextmanager
def _signals_blocked() -> Iterator[None]:
    """Keep signals from a new process until it handles them in its own way."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _run(function: Callable[[], None], parent: int) -> NoReturn:
    """Call the function and end the process: with code 0, or as if the signal had ended it."""
    try:
        _handle_signals()
        threading.Thread(target=_end_with_parent, args=(parent,), daemon=True).start()
        function()
    except ProcessTerminated:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTERM)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


def _handle_signals() -> None:
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _terminate)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)


def _terminate(_number: int, _frame: FrameType | None) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise ProcessTerminated


def _end_with_parent(parent: int) -> None:
    while os.getppid() == parent:  # wait ends: with the parent, which this thread waits for
        time.sleep(PARENT_POLL_S)
    os._exit(1)
