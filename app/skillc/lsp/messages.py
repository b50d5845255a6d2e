"""Reads and writes messages with validation: pygls accepts any header and any JSON value as a message."""

from __future__ import annotations

import logging
import re
from typing import Any, BinaryIO

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams
from pygls.protocol import JsonRPCProtocol, LanguageServerProtocol

from skillc.errors import ServiceError

LONGEST_HEADER = 1 << 12
MOST_BYTES = 1 << 28
"""The longest message accepted, in bytes; a skill file is at most a hundredth of it."""
_HEADER = re.compile(rb"[A-Za-z-]+: [^\r\n]*\r\n")
_LENGTH = re.compile(rb"Content-Length: (\d{1,10})\r\n")


class MalformedMessage(ServiceError):
    """The input is not a message, so the start of the next one is unknown; the text says why."""


class MessageWriter:
    """The standard output of the server. `refused` is the first error of a write; pygls would retry for ever."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.refused: OSError | None = None

    def write(self, data: bytes) -> None:
        """Write a message and flush, unless a write has failed before."""
        if self.refused is None:
            try:
                self._stream.write(data)
                self._stream.flush()
            except OSError as error:
                self.refused = error

    def flush(self) -> None:
        """Do nothing: `write` flushes."""

    def close(self) -> None:
        """Do nothing: the stream belongs to the process."""


class MessageReader:
    """The standard input of the server: header lines, then a body of Content-Length bytes."""

    def __init__(self, stream: BinaryIO, answers: MessageWriter) -> None:
        self._stream = stream
        self._answers = answers

    def readline(self) -> bytes:
        """Return the next line; MalformedMessage if it is neither a header nor the empty line after the headers.

        If the output is closed, the input counts as ended.
        """
        if self._answers.refused is not None:
            return b""
        line = self._stream.readline(LONGEST_HEADER)
        if line.strip() and not _HEADER.fullmatch(line):
            raise MalformedMessage(f"{_shown(line)} is not a header; `skillc lsp` is started by editors")
        if line.lower().startswith(b"content-length"):
            length = _LENGTH.fullmatch(line)
            if length is None or int(length[1]) > MOST_BYTES:
                raise MalformedMessage(f"{_shown(line)} is not a valid message length; the maximum is {MOST_BYTES}")
        return line

    def read(self, count: int) -> bytes:
        """Return the bytes of a message; fewer if the input ends."""
        return self._stream.read(count)


class Protocol(LanguageServerProtocol):
    """The protocol, which reports JSON values that are not messages to the editor."""

    def handle_message(self, message: Any) -> None:
        """Handle a message; show an error in the editor if it is not a JSON-RPC object."""
        if getattr(message, "jsonrpc", None) is not None:
            super().handle_message(message)
            return
        wrong = "ignored input that is not a JSON-RPC message (an object with `jsonrpc`)"
        self._server.window_show_message(types.ShowMessageParams(types.MessageType.Error, wrong))


def _is_news(record: logging.LogRecord) -> bool:
    """Return whether a log record is of something else than a request that was refused, which the editor shows."""
    return record.exc_info is None or not isinstance(record.exc_info[1], JsonRpcInvalidParams)


logging.getLogger(JsonRPCProtocol.__module__).addFilter(_is_news)


def _shown(line: bytes) -> str:
    return repr(line[:60].decode("utf-8", errors="replace").strip())
