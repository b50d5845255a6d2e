"""A language server in a process of its own, and the few messages that an editor sends it."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from itertools import count
from typing import IO, Any

SERVER = [sys.executable, "-c", "from skillc.cli.main import main; main(['lsp', '--stdio'])"]
PATIENCE_S = 60.0
_ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
"""The server finds the Python modules that `check` finds in this process."""
PUBLISHED = "textDocument/publishDiagnostics"
REFUSED = -32602
"""The code of an answer that says why what was asked cannot be done there, as a rename of a keyword."""


class Server:
    """A server that was initialised; AssertionError when it does not answer, or answers with an error of its own."""

    def __init__(self) -> None:
        self._process = subprocess.Popen(
            SERVER, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=_ENVIRONMENT
        )
        self._inbox: queue.Queue[dict[str, Any] | None] = queue.Queue()
        self._numbers = count(1)
        self.published: dict[str, list[dict[str, Any]]] = {}
        threading.Thread(target=self._read, args=(self._process.stdout,), daemon=True).start()
        self.request("initialize", {"processId": None, "rootUri": None, "capabilities": {}})
        self.notify("initialized", {})

    def notify(self, method: str, params: object) -> None:
        """Send what has no answer."""
        self._send({"method": method, "params": params})

    def request(self, method: str, params: object) -> Any:
        """Send a request and return its answer."""
        number = next(self._numbers)
        self._send({"id": number, "method": method, "params": params})
        while (message := self._receive()).get("id") != number:
            self._note(message)
        error = message.get("error")
        assert error is None or error["code"] == REFUSED, f"{method}: {error}"
        return message.get("result")

    def wait_for_diagnostics(self, uri: str, wanted: object) -> None:
        """Wait until the diagnostics of a file are those wanted, as `summarise` gives them."""
        while summarise(self.published.get(uri, ())) != wanted:
            try:
                self._note(self._receive())
            except AssertionError as error:
                shown = summarise(self.published.get(uri, ()))
                raise AssertionError(f"{error}: the editor shows {shown}, wanted {wanted}") from None

    def stop(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()

    def _note(self, message: dict[str, Any]) -> None:
        if message.get("method") == PUBLISHED:
            self.published[message["params"]["uri"]] = message["params"]["diagnostics"]
        assert message.get("method") != "window/showMessage", message["params"]["message"]

    def _receive(self) -> dict[str, Any]:
        try:
            message = self._inbox.get(timeout=PATIENCE_S)
        except queue.Empty:
            raise AssertionError("the server says nothing") from None
        assert message is not None, f"the server ended, exit code {self._process.wait()}"
        return message

    def _send(self, message: dict[str, object]) -> None:
        assert self._process.stdin is not None
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self._process.stdin.flush()

    def _read(self, stream: IO[bytes]) -> None:
        while header := stream.readline():
            if header.lower().startswith(b"content-length:"):
                length = int(header.split(b":")[1])
                while stream.readline().strip():
                    pass
                self._inbox.put(json.loads(stream.read(length)))
        self._inbox.put(None)


def summarise(diagnostics: Any) -> list[tuple[int, str]]:
    """Return the line, from 1, and the name of each diagnostic, in order."""
    return sorted((each["range"]["start"]["line"] + 1, each["code"]) for each in diagnostics)
