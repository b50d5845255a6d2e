"""The WebSocket of a language server: each frame is a message of the Language Server Protocol, without its header."""

from __future__ import annotations

import asyncio
import os
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager, suppress
from http import HTTPStatus
from typing import Any

import msgspec
from starlette.websockets import WebSocket

from skillc.contract.source import LanguageHello
from skillc.server.access.roles import includes
from skillc.server.access.tokens import Client
from skillc.server.context import ServerContext
from skillc.server.http.authentication import make_credential
from skillc.server.http.event_stream import BROKEN, HELLO_S, SILENCE_S, ClientSocket, closing_refused
from skillc.server.language.uris import TextUris, UnknownText
from skillc.server.problems import ApiRefusal

MAX_BYTES = 1 << 26
"""The largest message that a language server sends."""
MODULE = "skillc.workers.language_server"

INVALID_PARAMS, METHOD_NOT_FOUND = -32602, -32601
OTHER_METHODS = frozenset(
    {"initialized", "shutdown", "exit", "$/cancelRequest", "workspace/symbol", "workspace/didChangeWatchedFiles"}
)
RUN_TEST = "skillc/runTest"
"""Runs what a page has written, functions in Python included: only for who may change libraries."""


async def stream_language(server: ServerContext, socket: WebSocket) -> None:
    """Let a client talk with a language server of its own until it is gone, or its token is revoked."""
    await socket.accept()  # wait ends: at once, since the request is there
    async with closing_refused(socket):
        with server.watchers.introducing():
            content = await asyncio.wait_for(socket.receive_text(), HELLO_S)
            hello = msgspec.json.decode(content, type=LanguageHello)
            client = ClientSocket(server, socket, make_credential(server, socket, hello.token))
            name = client.check_client().name
        library = server.find_library(hello.library)
        with server.watchers.watching(name), server.language_servers.watching(name):
            folder = library.checked.basis.folders[0]
            async with language_server(library.environment, folder) as running:
                await _connect(client, running, TextUris(library))


async def _connect(client: ClientSocket, running: LanguageServer, uris: TextUris) -> None:
    """Pass messages on in both directions until one side ends."""
    passing = [
        asyncio.create_task(_pass_on(client, running, uris)),
        asyncio.create_task(_pass_back(client, running, uris)),
    ]
    try:
        done: set[asyncio.Task[None]] = set()
        while not done:
            done, _ = await asyncio.wait(passing, timeout=SILENCE_S, return_when=asyncio.FIRST_COMPLETED)
            client.check_client()
        for each in done:
            each.result()
    except LanguageServerEnded as ended:
        await client.socket.close(BROKEN, str(ended))
    finally:
        for each in passing:
            each.cancel()
        await asyncio.gather(*passing, return_exceptions=True)


async def _pass_on(client: ClientSocket, running: LanguageServer, uris: TextUris) -> None:
    while True:
        message = await _receive(client)
        try:
            _check_right(client.check_client(), message)
            await running.send(await asyncio.to_thread(_prepare, message, uris))
        except UnknownText as error:
            await _refuse(client, message, INVALID_PARAMS, str(error))
        except (NotImplementedError, PermissionError) as error:
            await _refuse(client, message, METHOD_NOT_FOUND, str(error))


def _check_right(client: Client, message: dict[str, Any]) -> None:
    """PermissionError for what a client may not ask."""
    if message.get("method") == RUN_TEST and (client.agent or not includes(client.role, "edit")):
        raise PermissionError("tests are run for people with the role `edit`")


async def _receive(client: ClientSocket) -> dict[str, Any]:
    """Return the next message of a client; ApiRefusal if it is none."""
    try:
        content = await client.socket.receive_text()
        client.check_client()
        return msgspec.json.decode(content, type=dict[str, Any])
    except (msgspec.DecodeError, RecursionError, KeyError) as error:
        raise ApiRefusal(HTTPStatus.BAD_REQUEST, "a message is no JSON object") from error


async def _pass_back(client: ClientSocket, running: LanguageServer, uris: TextUris) -> None:
    while True:
        message = await running.receive()
        client.check_client()
        shown = await asyncio.to_thread(uris.to_page, message)
        await client.socket.send_text(msgspec.json.encode(shown).decode())


def _prepare(message: dict[str, Any], uris: TextUris) -> Any:
    """Return a message for the language server, which sees the folder of the library alone.

    UnknownText if the message names anything else, NotImplementedError for a method that pages do not have.
    """
    method = message.get("method", "")
    if method == "initialize":
        params = message.get("params")
        given = params if isinstance(params, dict) else {}
        options = {"capabilities": given.get("capabilities", {})}
        if isinstance(told := given.get("initializationOptions"), dict):
            options["initializationOptions"] = {"commands": told.get("commands")}
        folders = [{"uri": uris.root, "name": uris.library.checked.name}]
        opened = {"processId": None, "rootUri": uris.root, "workspaceFolders": folders}
        return {**message, "params": {**options, **opened}}
    if method and not _is_known(method):
        raise NotImplementedError(f"pages do not have the method {str(method)[:100]}")
    return uris.from_page(message)


def _is_known(method: object) -> bool:
    """Whether pages have a method."""
    return isinstance(method, str) and (method.startswith("textDocument/") or method in (*OTHER_METHODS, RUN_TEST))


async def _refuse(client: ClientSocket, message: dict[str, Any], code: int, why: str) -> None:
    """Answer a request with an error; a notification has no answer."""
    if "id" in message:
        answer = {"jsonrpc": "2.0", "id": message["id"], "error": {"code": code, "message": why}}
        await client.socket.send_text(msgspec.json.encode(answer).decode())


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
