"""The process of one language server, with the messages of the Language Server Protocol as JSON values."""

from __future__ import annotations

import asyncio
import os
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager, suppress
from typing import Any

import msgspec

MAX_BYTES = 1 << 26
"""The largest message that a language server sends."""
MODULE = "skillc.workers.language_server"


class LanguageServerEnded(Exception):
    """The process has ended, or sends what is no message."""


class LanguageServer:
    """A language server that runs."""

    def __init__(self, process: Process) -> None:
        assert process.stdin is not None and process.stdout is not None
        self._input, self._output = process.stdin, process.stdout

    async def send(self, message: object) -> None:
        """Send a message; waits while the server has enough to do. LanguageServerEnded if it has ended."""
        content = msgspec.json.encode(message)
        try:
            self._input.write(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))
            await self._input.drain()  # the process reads on, or is killed with the WebSocket
        except (BrokenPipeError, ConnectionResetError) as error:
            raise LanguageServerEnded("the language server has ended") from error

    async def receive(self) -> Any:
        """Return the next message; LanguageServerEnded if there is none."""
        try:
            length = await self._read_length()
            return msgspec.json.decode(await self._output.readexactly(length))
        except (asyncio.IncompleteReadError, asyncio.LimitOverrunError, ValueError, msgspec.DecodeError) as error:
            raise LanguageServerEnded("the language server has ended") from error

    async def _read_length(self) -> int:
        head = await self._output.readuntil(b"\r\n\r\n")
        fields = dict(line.lower().split(b":", 1) for line in head.strip().split(b"\r\n"))
        length = int(fields.get(b"content-length", b"-1"))
        if not 0 <= length <= MAX_BYTES:
            raise ValueError("a length of a message")
        return length


@asynccontextmanager
async def language_server(environment: Mapping[str, str], folder: str) -> AsyncIterator[LanguageServer]:
    """Run a language server in a folder, in a `with` statement; its process is killed at the end. OSError."""
    variables = {**os.environ, **environment}
    command = (sys.executable, "-m", MODULE)
    process = await asyncio.create_subprocess_exec(
        *command, stdin=PIPE, stdout=PIPE, stderr=DEVNULL, cwd=folder, env=variables
    )
    try:
        yield LanguageServer(process)
    finally:
        with suppress(ProcessLookupError):
            process.kill()
        await process.communicate()  # wait ends: it was killed; `wait` alone never ends while there is output to read
