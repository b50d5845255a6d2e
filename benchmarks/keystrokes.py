"""Time from a keystroke to its diagnostics, by the real language server over pipes, and its memory.

Run it as `python benchmarks/keystrokes.py [EDITS]`. It prints, for files of 500 and 3,000 lines and for a library of
10,000 lines in 190 files, the median and 95th percentile in ms, the ratio of the latter to the start of a process
that imports click, the processor time in ms, and the memory before and after. Each edit makes another mistake: a wrong
unit, a cut line, an unknown name.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from statistics import median, quantiles
from tempfile import TemporaryDirectory
from typing import Any

from _one_file import one_file
from _processes import cpu_s, rss_mb
from compile import MANIFEST, generated

WARM_UP = 5
_QUANTITY = re.compile(r"(?<== )[\d.]+ (?:m/s|mm|N)\b")


class Server:
    """A language server at the other end of two pipes."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-c", "from skillc.cli.main import main; main()", "lsp"]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self._call("initialize", {"processId": None, "rootUri": folder.as_uri(), "capabilities": {}})
        self.notify("initialized", {})

    def notify(self, method: str, params: Mapping[str, Any]) -> None:
        """Send a notification."""
        self._send({"jsonrpc": "2.0", "method": method, "params": params})

    def diagnostics_of(self, uri: str) -> list[Any]:
        """Return the diagnostics of a file that are published next."""
        while True:
            message = self._read()
            if message.get("method") == "textDocument/publishDiagnostics" and message["params"]["uri"] == uri:
                return list(message["params"]["diagnostics"])

    def end(self) -> None:
        """End the server."""
        self._call("shutdown", None)
        self.notify("exit", {})
        self.process.wait(10)

    def _call(self, method: str, params: Mapping[str, Any] | None) -> None:
        self._send({"jsonrpc": "2.0", "id": 1, "method": method, "params": params})
        while "id" not in self._read():
            pass

    def _send(self, message: Mapping[str, Any]) -> None:
        assert self.process.stdin is not None
        body = json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def _read(self) -> dict[str, Any]:
        assert self.process.stdout is not None
        size = 0
        while (line := self.process.stdout.readline().strip()) or not size:
            if line.startswith(b"Content-Length:"):
                size = int(line.split(b":")[1])
        found: dict[str, Any] = json.loads(self.process.stdout.read(size))
        return found


def main() -> None:
    """Print one line for each library."""
    edits = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    many = {source.path: source.text for source in generated(10_000)}
    edited = next(path for path, text in sorted(many.items()) if _QUANTITY.search(text))
    start = min(_start_of_click() for _ in range(5))
    print(f"{'':28} {'median':>7} {'p95':>7} {'ratio':>6} {'CPU':>6} {'MB':>6} {'after':>6}")
    for name, files, path in (
        ("500 lines", {"all.skill": one_file(500)}, "all.skill"),
        ("3,000 lines", {"all.skill": one_file(3000)}, "all.skill"),
        (f"{len(many)} files", many, edited),
    ):
        with TemporaryDirectory() as folder:
            seconds, processor_s, before, after = measure(Path(folder), files, path, edits)
        late = quantiles(seconds, n=20)[-1]
        times = f"{median(seconds) * 1e3:7.0f} {late * 1e3:7.0f} {late / start:6.2f} {processor_s / edits * 1e3:6.0f}"
        print(f"{name:28} {times} {before:6.0f} {after:6.0f}")


def measure(folder: Path, files: Mapping[str, str], path: str, edits: int) -> tuple[list[float], float, float, float]:
    """Return the seconds of each edit, those of the processor for all, and the memory in MB before and after."""
    (folder / "skillc.toml").write_text(MANIFEST, "utf-8")
    for name, text in files.items():
        (folder / name).write_text(text, "utf-8")
    server, uri, text = Server(folder), (folder / path).as_uri(), files[path]
    server.notify(
        "textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "skill", "version": 1, "text": text}}
    )
    server.diagnostics_of(uri)
    taken, before, used = [], 0.0, 0.0
    for number in range(WARM_UP + edits):
        if number == WARM_UP:
            before, used = rss_mb(server.process.pid), cpu_s(server.process.pid)
        new = {"text": _mistaken(text, number)}
        begin = time.perf_counter()
        document = {"uri": uri, "version": number + 2}
        server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [new]})
        server.diagnostics_of(uri)
        taken.append(time.perf_counter() - begin)
    after, used = rss_mb(server.process.pid), cpu_s(server.process.pid) - used
    server.end()
    return taken[WARM_UP:], used, before, after


def _mistaken(text: str, number: int) -> str:
    """Return the text with a mistake that differs from the one before."""
    places = [match.span() for match in _QUANTITY.finditer(text)]
    start, end = places[len(places) // 2]
    quantity = text[start:end]
    match number % 3:
        case 0:
            return f"{text[:start]}0.{number + 10} furlong{text[end:]}"
        case 1:
            return text[:start] + text[text.index("\n", start) :]
    return f"{text[:start]}{quantity} * unknown_{number}{text[end:]}"


def _start_of_click() -> float:
    begin = time.perf_counter()
    subprocess.run([sys.executable, "-c", "import click"], check=True)
    return time.perf_counter() - begin


if __name__ == "__main__":
    main()
