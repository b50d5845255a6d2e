"""What an editor sends, refused where it is no message: pygls trusts headers, and takes any JSON for a message."""

from __future__ import annotations

import re
from typing import Any, BinaryIO

from lsprotocol import types
from pygls.protocol import LanguageServerProtocol

from skillc.services.errors import ServiceError

LONGEST_HEADER = 1 << 12
MOST_BYTES = 1 << 28
"""What is longer is no message that an editor sends; a text of skills is at most a hundredth of it."""
_HEADER = re.compile(rb"[A-Za-z-]+: [^\r\n]*\r\n")
_LENGTH = re.compile(rb"Content-Length: (\d{1,10})\r\n")


class Malformed(ServiceError):
    """What was sent is no message, and where the next one begins cannot be known; the text says why."""


class Answers:
    """The standard output of the server. `refused` is why it takes nothing more; pygls would try again without end."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self.refused: OSError | None = None

    def write(self, data: bytes) -> None:
        """Write a message at once, unless one was refused before."""
        if self.refused is None:
            try:
                self._stream.write(data)
                self._stream.flush()
            except OSError as error:
                self.refused = error

    def flush(self) -> None:
        """Do nothing: all is written already."""

    def close(self) -> None:
        """Do nothing: the stream is the process's own."""


class Messages:
    """The standard input of the server: lines of headers, and as many bytes as they announce."""

    def __init__(self, stream: BinaryIO, answers: Answers) -> None:
        self._stream = stream
        self._answers = answers

    def readline(self) -> bytes:
        """Return the next line; Malformed where it is no header and not the empty line after them.

        An editor that takes no answers has no more questions.
        """
        if self._answers.refused is not None:
            return b""
        line = self._stream.readline(LONGEST_HEADER)
        if line.strip() and not _HEADER.fullmatch(line):
            raise Malformed(f"{_shown(line)} is no header; `skillc lsp` speaks with editors, not with people")
        if line.lower().startswith(b"content-length"):
            length = _LENGTH.fullmatch(line)
            if length is None or int(length[1]) > MOST_BYTES:
                raise Malformed(f"{_shown(line)} is no length of a message: a number up to {MOST_BYTES} is")
        return line

    def read(self, count: int) -> bytes:
        """Return the bytes of a message; fewer where the input ends."""
        return self._stream.read(count)


class Protocol(LanguageServerProtocol):
    """The protocol, which answers what is JSON and no message with words."""

    def handle_message(self, message: Any) -> None:
        """Handle a message; tell the editor of one that is none."""
        if getattr(message, "jsonrpc", None) is not None:
            super().handle_message(message)
            return
        wrong = "what the editor sent is no JSON-RPC message: an object with `jsonrpc` is; it is left out"
        self._server.window_show_message(types.ShowMessageParams(types.MessageType.Error, wrong))


def _shown(line: bytes) -> str:
    return repr(line[:60].decode("utf-8", errors="replace").strip())
