"""A cell in a process of its own, as its server sees it."""

from __future__ import annotations

import asyncio
import os
import socket
import sys
from asyncio.subprocess import Process
from collections.abc import Callable
from contextlib import suppress
from itertools import count
from pathlib import Path
from typing import TextIO

import msgspec

from skillc.cells.frames import LENGTH, encode_frame
from skillc.cells.settings import CellSettings
from skillc.contract.messages import CellAnswer, CellRequest, Message, Report, StopRequest


class CellGone(Exception):
    """The process of a cell has ended, or ends."""


class RemoteCell:
    """The process of a cell. Requests go to it; `report` is called with each of its reports but answers.

    `gone` is done with the exit code, negative for a signal, once the process has ended.
    """

    def __init__(
        self, process: Process, requests: FrameStream, stops: FrameStream, report: Callable[[Report], None]
    ) -> None:
        self._process, self._requests, self._stops, self._report = process, requests, stops, report
        self._numbers = count(1)
        self._unanswered: dict[int, asyncio.Future[CellAnswer]] = {}
        self.gone = asyncio.ensure_future(self._follow())

    @property
    def pid(self) -> int:
        """The id of the process."""
        return self._process.pid

    async def request(self, message: Message) -> CellAnswer:
        """Send a message and wait for its answer: what it asks for is done and durable, or refused.

        CellGone if the process ends before it answers.
        """
        if self.gone.done():
            raise CellGone(_describe_end(self.gone.result()))
        number = next(self._numbers)
        answer: asyncio.Future[CellAnswer] = asyncio.get_running_loop().create_future()
        self._unanswered[number] = answer
        try:
            self._requests.send(CellRequest(number, message))
            return await answer
        finally:
            del self._unanswered[number]

    def stop(self, reason: str, operation: str | None = None) -> None:
        """Stop an operation in the next tick, or all; nothing can hold it up."""
        self._stops.send(StopRequest(reason, operation))

    def abandon(self) -> None:
        """Close the sockets: the cell interrupts what runs, and ends."""
        self._requests.close()
        self._stops.close()

    def kill(self) -> None:
        """End the process at once."""
        with suppress(ProcessLookupError):
            self._process.kill()

    async def _follow(self) -> int:
        """Take reports until the process has ended."""
        decoder = msgspec.msgpack.Decoder(Report)
        with suppress(asyncio.IncompleteReadError, ConnectionError):
            while True:
                self._take(decoder.decode(await self._requests.receive()))
        code = await self._process.wait()  # wait ends: with the process, whose supervisor kills it if it falls silent
        self.abandon()
        for waiting in self._unanswered.values():
            if not waiting.done():
                waiting.set_exception(CellGone(_describe_end(code)))
        return code

    def _take(self, report: Report) -> None:
        """Pass an answer to whoever waits for it, and other reports on."""
        if not isinstance(report, CellAnswer):
            self._report(report)
        elif (waiting := self._unanswered.get(report.number)) is not None and not waiting.done():
            waiting.set_result(report)


class FrameStream:
    """A socket whose other end a cell has; it carries frames."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader, self._writer = reader, writer

    def send(self, value: object) -> None:
        """Send a value; nothing happens if the other end is gone."""
        self._writer.write(encode_frame(value))

    async def receive(self) -> bytes:
        """Wait for a frame and return its content; IncompleteReadError or ConnectionError at the end."""
        (length,) = LENGTH.unpack(await self._reader.readexactly(LENGTH.size))
        return await self._reader.readexactly(length)

    def close(self) -> None:
        """Close the socket."""
        self._writer.close()


async def start_cell(settings: CellSettings, log: TextIO, report: Callable[[Report], None]) -> RemoteCell:
    """Start the process of a cell, which writes messages to `log`; its first `StatusChanged` says that it is ready.

    OSError if there can be no more processes.
    """
    ours, theirs = zip(*(socket.socketpair() for _ in range(2)), strict=True)
    try:
        command = (sys.executable, "-P", "-m", "skillc.cells.process", *(str(each.fileno()) for each in theirs))
        paths = os.pathsep.join(str(Path(path).absolute()) for path in sys.path if path)
        process = await asyncio.create_subprocess_exec(
            *command,
            pass_fds=[each.fileno() for each in theirs],
            stdin=asyncio.subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            start_new_session=True,
            env={**os.environ, "PYTHONPATH": paths, **settings.environment},
        )
    except BaseException:
        for each in ours:
            each.close()
        raise
    finally:
        for each in theirs:
            each.close()
    requests, stops = [FrameStream(*await asyncio.open_connection(sock=each)) for each in ours]
    requests.send(settings)
    return RemoteCell(process, requests, stops, report)


def _describe_end(code: int) -> str:
    return f"the process of the cell ended with {f'signal {-code}' if code < 0 else f'code {code}'}"
