"""Runs a function in a process that can be killed at any time, and that ends when this process does."""

from __future__ import annotations

import gc
import os
import pickle
import select
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import FrameType
from typing import Any, Literal, NoReturn, TextIO, TypeAlias, cast

StartMethod: TypeAlias = Literal["fork", "spawn"]
DEFAULT_START: StartMethod = "fork" if sys.platform == "linux" else "spawn"
"""A fork starts at once; system libraries of macOS do not work in forks."""

CLEANUP_S = 2.0
"""How long a worker may take to end the programs that it started, and to remove its files, before it is killed."""
POLL_S = 0.05
"""The interval at which a worker checks whether its parent still runs, and at which a wait for it is interrupted."""
_PAUSE_S = 0.001
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_SPAWNED = "import pickle, sys; sys.path[:] = pickle.load(sys.stdin.buffer); pickle.load(sys.stdin.buffer)()"


@dataclass(frozen=True, slots=True)
class Returned:
    """The function returned `value`."""

    value: Any


@dataclass(frozen=True, slots=True)
class Died:
    """The function raised an exception or its process died; `why` is a sentence without a full stop."""

    why: str


WorkerResult: TypeAlias = Returned | Died


class WorkerProcess:
    """A process that runs a function, which must not use devices, stores or locks of this process.

    `poll` never blocks; `kill` ends the process and the programs that it started in sandboxes.
    """

    def __init__(self, function: Callable[[], object], start: StartMethod = DEFAULT_START) -> None:
        """Start it; with "spawn" the function is pickled. OSError if there can be no more processes."""
        self._reader, writer = os.pipe()
        try:
            os.set_blocking(self._reader, False)
            self._process = _fork(function, writer) if start == "fork" else _spawn(function, writer)
        except BaseException:
            os.close(self._reader)
            raise
        finally:
            os.close(writer)
        self._received = bytearray()
        self._result: WorkerResult | None = None

    @property
    def pid(self) -> int:
        """The id of the process."""
        return self._process.pid

    def poll(self) -> WorkerResult | None:
        """Return the result if the process has ended, else None."""
        if self._result is None:
            code = self._process.poll()
            self._receive()
            if code is not None:
                self._end(_read_result(bytes(self._received), code))
        return self._result

    def wait(self, seconds: float) -> WorkerResult | None:
        """Wait for the result for up to `seconds`; None if there is none yet."""
        end = time.monotonic() + seconds
        while (result := self.poll()) is None and (left := end - time.monotonic()) > 0.0:
            if not select.select((self._reader,), (), (), min(left, POLL_S))[0]:
                continue
            time.sleep(
                min(left, 0.001)
            )  # the pipe is readable from the first byte of the result until the process ends
        return result

    def kill(self) -> None:
        """End the process within CLEANUP_S; a result that has not been returned by then is Died."""
        if self._result is not None:
            return
        self._process.terminate()
        if self.wait(CLEANUP_S) is None:
            self._process.kill()
            self._process.wait(CLEANUP_S)
            self._end(Died("it was killed"))

    def _receive(self) -> None:
        with suppress(BlockingIOError):
            while part := os.read(self._reader, 2**16):
                self._received += part

    def _end(self, result: WorkerResult) -> None:
        self._result = result
        os.close(self._reader)


class _Forked:
    """A forked process, with the methods of `subprocess.Popen` that are used here."""

    def __init__(self, pid: int) -> None:
        self.pid, self._code = pid, cast("int | None", None)

    def poll(self) -> int | None:
        if self._code is None:
            try:
                pid, status = os.waitpid(self.pid, os.WNOHANG)
            except ChildProcessError:  # this process ignores the ends of its children
                self._code = 0
            else:
                self._code = os.waitstatus_to_exitcode(status) if pid else None
        return self._code

    def wait(self, timeout: float) -> None:
        end = time.monotonic() + timeout
        while self.poll() is None and time.monotonic() < end:
            time.sleep(_PAUSE_S)

    def terminate(self) -> None:
        self._send(signal.SIGTERM)

    def kill(self) -> None:
        self._send(signal.SIGKILL)

    def _send(self, number: signal.Signals) -> None:
        if self.poll() is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)


def _fork(function: Callable[[], object], writer: int) -> _Forked:
    parent = os.getpid()
    with _signals_blocked(), warnings.catch_warnings():
        # Other threads may hold locks at this moment; the worker takes none of theirs, see `_run_forked`.
        warnings.filterwarnings("ignore", r"This process .* is multi-threaded", DeprecationWarning)
        pid = os.fork()
        if pid == 0:
            _run_forked(function, writer, parent)
    return _Forked(pid)


def _run_forked(function: Callable[[], object], writer: int, parent: int) -> NoReturn:
    """Run the function in a fork, which must not destroy what it shares with its parent.

    Objects of the parent are never collected, so that no destructor of a store, a socket or a temporary folder runs.
    Output that the parent has buffered is never written, because the streams are new.
    """
    try:
        gc.freeze()
        inherited = sys.stdout, sys.stderr
        sys.stdout, sys.stderr = _open_stream(1), _open_stream(2)
        _serve(function, writer, parent)
        del inherited
    finally:
        os._exit(1)


def _open_stream(number: int) -> TextIO:
    try:
        return os.fdopen(number, "w", encoding="utf-8", errors="replace", closefd=False)
    except OSError:  # this process has no such stream
        return Path(os.devnull).open("w", encoding="utf-8")


def _spawn(function: Callable[[], object], writer: int) -> subprocess.Popen[bytes]:
    """Run the function in a new interpreter; what it imports is found on the same path as here."""
    with tempfile.TemporaryFile() as request:
        pickle.dump(sys.path, request)
        pickle.dump(partial(_serve, function, writer, os.getpid()), request)
        request.seek(0)
        with _signals_blocked():
            return subprocess.Popen((sys.executable, "-c", _SPAWNED), stdin=request, pass_fds=(writer,))


@contextmanager
def _signals_blocked() -> Iterator[None]:
    """Keep signals from a new process until it handles them in its own way."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _Terminated(BaseException):
    """The process was asked to end."""


def _serve(function: Callable[[], object], writer: int, parent: int) -> None:
    """Call the function in a worker and write its result; the signals that reach its parent are left to that."""
    try:
        _handle_signals()
        threading.Thread(target=_end_with_parent, args=(parent,), daemon=True).start()
        message = _call(function)
        signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)
    except _Terminated:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTERM)
        return
    while message:
        message = message[os.write(writer, message) :]
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


def _handle_signals() -> None:
    signal.set_wakeup_fd(-1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _terminate)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGNALS)


def _terminate(_number: int, _frame: FrameType | None) -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    raise _Terminated


def _end_with_parent(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(POLL_S)
    os._exit(1)


def _call(function: Callable[[], object]) -> bytes:
    """Return the result of the function, pickled."""
    try:
        return pickle.dumps(Returned(function()))
    except _Terminated:
        raise
    except BaseException as error:  # noqa: BLE001  the boundary of the process: every failure becomes a result
        place = traceback.extract_tb(error.__traceback__)[-1]
        return pickle.dumps(Died(f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"))


def _read_result(message: bytes, code: int) -> WorkerResult:
    if code == 0 and message:
        return cast(WorkerResult, pickle.loads(message))
    return Died(f"its process ended with {f'signal {-code}' if code < 0 else f'code {code}'}")
