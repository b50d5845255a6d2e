"""The server ends with its editor, however that leaves, and leaves nothing behind."""

from __future__ import annotations

import json
import subprocess

from editor.conftest import SERVER
from waiting import LONG_S


def message(method: str, number: int | None = None, **params: object) -> bytes:
    """Return a message of the protocol; one with a number is a request."""
    content: dict[str, object] = {"jsonrpc": "2.0", "method": method, "params": params}
    if number is not None:
        content["id"] = number
    body = json.dumps(content).encode()
    return b"Content-Length: %d\r\n\r\n%s" % (len(body), body)


HELLO = message("initialize", 1, processId=None, rootUri=None, capabilities={}) + message("initialized")


def served(text: bytes) -> subprocess.CompletedProcess[bytes]:
    """Run a server that reads a text and then the end of its input."""
    return subprocess.run(SERVER, input=text, capture_output=True, timeout=LONG_S, check=False)


def test_goodbye_and_exit_end_it_with_0() -> None:
    done = served(HELLO + message("shutdown", 2) + message("exit"))
    assert (done.returncode, done.stderr) == (0, b"")
    assert b'"renameProvider"' in done.stdout


def test_an_editor_that_vanishes_ends_it_with_1() -> None:
    assert served(HELLO).returncode == 1
