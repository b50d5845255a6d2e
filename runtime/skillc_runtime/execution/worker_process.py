"""A process that calls a function for one request after the other, can be killed, and ends when this process does."""

from __future__ import annotations

import pickle
import selectors
import socket
import struct
import sys
import traceback
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias, cast

import msgspec

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.platforms.processes import DEFAULT_START, StartMethod, join_process, start_process
from skillc_runtime.platforms.started_process import ProcessTerminated

CLEANUP_S = 2.0
"""How long a worker may take to end the programs that it started, and to remove its files, before it is killed."""
SEND_S = 5.0
"""How long a worker may take to accept a request, in s."""
MAX_WAIT_S = 3600.0
LOOK_S = 0.1
"""How often `answer` looks whether somebody still waits for an answer, in s."""
_HEADER = struct.Struct("!Q")
_CHUNK = 2**16


class Returned(msgspec.Struct, frozen=True):
    """The function returned `value`."""

    value: Any


class Raised(msgspec.Struct, frozen=True):
    """The function raised an exception; `why` names it and its place."""

    why: str


class Died(msgspec.Struct, frozen=True):
    """The process ended, or was killed, without a result."""

    why: str


WorkerResult: TypeAlias = Returned | Raised | Died


class Report(msgspec.Struct, frozen=True):
    """The function goes on; `value` says how far it is."""

    value: Any


class ReportingFunction(msgspec.Struct, frozen=True):
    """A function of a request and of another function, which it may call with how far it is."""

    function: Callable[[Any, Callable[[object], None]], object]


WorkerFunction: TypeAlias = Callable[[Any], object] | ReportingFunction


class WorkerProcess:
    """A process that calls a function, which must not use devices, stores or locks of this process.

    On Windows it is a thread of this process, and one that is killed goes on until its function returns.

    `ask` sends a request, `poll` returns its result and never blocks; after `poll` found none, `report` is how far the
    function is, as it has said last. `kill` ends the process and the programs that it started in sandboxes,
    `kill_at_once` the process alone, without waiting for it. A process that has died stays so.

    Use a worker in one thread at a time. To end a wait in `answer` from another thread, cancel its token.
    """

    def __init__(self, function: WorkerFunction, start: StartMethod = DEFAULT_START) -> None:
        """Start it; with "spawn" the function is pickled. OSError if there can be no more processes."""
        self._socket, remote = socket.socketpair()
        self._received = bytearray()
        self.report: Any = None
        self._result: WorkerResult | None = None
        self._dead: str | None = None
        try:
            self._socket.setblocking(False)
            end = (
                remote.dup().detach() if start == "thread" else remote.fileno()
            )  # a thread shares what is closed below
            self._process = start_process(partial(_serve, function, end), start, (end,))
        except BaseException:
            self._socket.close()
            raise
        finally:
            remote.close()

    @property
    def pid(self) -> int:
        """The id of the process."""
        return self._process.pid

    def fileno(self) -> int:
        """The file descriptor that can be read when there is news for `poll`."""
        return self._socket.fileno()

    def ask(self, request: object) -> None:
        """Send a request; the result of the former one is forgotten."""
        self.report, self._result = None, None if self._dead is None else Died(self._dead)
        if self._dead is not None:
            return
        message = pickle.dumps(request)
        self._socket.settimeout(SEND_S)
        with suppress(OSError):  # it has died or hangs, which is found out when the result is waited for
            self._socket.sendall(_HEADER.pack(len(message)) + message)
        self._socket.setblocking(False)

    def answer(self, request: object, cancel: CancelToken) -> WorkerResult | None:
        """Send a request, and wait for its result until that is cancelled; None then."""
        result: WorkerResult | None = None
        self.ask(request)
        while result is None and cancel.reason is None:
            result = self.wait(min(LOOK_S, cancel.remaining_s))
        return result

    def poll(self) -> WorkerResult | None:
        """Return the result of the last request if there is one, else None."""
        if self._result is None:
            code = self._process.poll()
            self._result = self._receive()
            if self._result is None and code is not None:
                self._end(f"its process ended with {f'signal {-code}' if code < 0 else f'code {code}'}")
        return self._result

    def wait(self, seconds: float) -> WorkerResult | None:
        """Wait for a result for up to `seconds`; None if there is none yet."""
        end = CancelToken(seconds)
        while self.poll() is None and end.remaining_s > 0.0:
            wait_for_any((self,), end.remaining_s)
        return self._result

    def kill(self) -> None:
        """End the process, within CLEANUP_S if it can; a request that has no result then has the result Died."""
        if self._dead is not None:
            return
        for end in (self._process.terminate, self._process.kill):
            end()
            if join_process(self._process, CLEANUP_S):
                break
        self._result = self._result or self._receive()
        self._end("it was killed")

    def kill_at_once(self, why: str) -> None:
        """End the process without letting it clean up, for `why`; it must not have started any programs."""
        if self._dead is None:
            self._process.kill()
            join_process(self._process, CLEANUP_S)
            self._end(why)

    def _receive(self) -> WorkerResult | None:
        with suppress(BlockingIOError, ConnectionResetError):
            while part := self._socket.recv(_CHUNK):  # wait ends: at once, since the socket does not block
                self._received += part
        while (message := _take_message(self._received)) is not None:
            received = pickle.loads(message)
            if not isinstance(received, Report):
                return cast(WorkerResult, received)
            self.report = received.value
        return None

    def _end(self, why: str) -> None:
        self._dead, self._result = why, self._result or Died(why)
        self._socket.close()


def wait_for_any(workers: Sequence[WorkerProcess], seconds: float) -> None:
    """Wait for up to `seconds` until one of the workers has a result or has died."""
    with selectors.DefaultSelector() as selector:
        for each in workers:
            selector.register(each.fileno(), selectors.EVENT_READ)
        selector.select(min(seconds, MAX_WAIT_S))


def _serve(function: WorkerFunction, remote: int) -> None:
    """Answer requests until the other end is closed."""
    with socket.socket(fileno=remote) as connection, suppress(BrokenPipeError, ConnectionResetError):
        received = bytearray()
        while part := connection.recv(_CHUNK):  # wait ends: with the parent, or when it closes the connection
            received += part
            while (message := _take_message(received)) is not None:
                result = _call(function, message, connection)
                sys.stdout.flush()
                sys.stderr.flush()
                connection.sendall(_HEADER.pack(len(result)) + result)


def _call(function: WorkerFunction, request: bytes, connection: socket.socket) -> bytes:
    """Return the result of the function for a request; both are pickled."""
    try:
        if isinstance(function, ReportingFunction):
            value = function.function(pickle.loads(request), partial(_send_report, connection))
        else:
            value = function(pickle.loads(request))
        return pickle.dumps(Returned(value))
    except ProcessTerminated:
        raise
    except BaseException as error:  # noqa: BLE001  the boundary of the process: every failure becomes a result
        place = traceback.extract_tb(error.__traceback__)[-1]
        return pickle.dumps(Raised(f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"))


def _send_report(connection: socket.socket, value: object) -> None:
    """Send how far the function is, unless nobody has read the former reports."""
    message = pickle.dumps(Report(value))
    with selectors.DefaultSelector() as selector:
        selector.register(connection, selectors.EVENT_WRITE)
        if selector.select(0.0):
            connection.sendall(_HEADER.pack(len(message)) + message)


def _take_message(received: bytearray) -> bytes | None:
    """Remove the first message from what was received; None while it is not complete."""
    if len(received) < _HEADER.size:
        return None
    end = _HEADER.size + _HEADER.unpack_from(received)[0]
    if len(received) < end:
        return None
    message = bytes(received[_HEADER.size : end])
    del received[:end]
    return message
