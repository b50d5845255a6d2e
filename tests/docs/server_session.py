"""Follows a session of blocks on serving cells in a shell, and compares what is printed with what the page shows."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from docs.pages import ROOT, Block, blocks

PAGE = ROOT / "docs/server.md"
HEADING = "\n## A session\n"
MARK = "=== block"
PORT = "8421"
"""The port of the pages; a session of a test has one that is free."""
SETUP = """until_ready() {{
    for _ in $(seq 300); do
        [ "$(skillc ps 2>/dev/null | grep -c operational)" = 2 ] && return
        sleep 0.2
    done
    echo the server is not ready; exit 1
}}
export SKILLC_SERVER=http://127.0.0.1:{port}
"""


def read_session(folder: Path) -> tuple[Block, ...]:
    """Return the blocks of the session; `folder` is for what is read."""
    (folder / "page.md").write_text(PAGE.read_text("utf-8").partition(HEADING)[2], "utf-8")
    return tuple(blocks(folder / "page.md"))


def follow_session(session: Sequence[Block], folder: Path) -> str:
    """Follow a session in a folder, check each output that it shows, and return all that was printed."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = str(free.getsockname()[1])
    printed = run_script("\n".join(write_script(session, port)), folder)
    expected = [each.text for each in session if each.language == "text"]
    parts = re.split(rf"^{MARK} \d+\n", printed, flags=re.MULTILINE)
    assert expected and len(parts) == len(expected) + 1, printed
    for part, text in zip(parts, expected, strict=False):
        check_output(part, text)
    return printed


def write_script(session: Sequence[Block], port: str) -> Iterator[str]:
    """Yield the lines of a session as a script of bash, which waits until a server is ready as a person would.

    A block with a word after its language is a file of that name.
    """
    yield SETUP.format(port=port)
    for number, block in enumerate(session):
        text = block.text.replace(PORT, port)
        if block.words:
            yield f"cat > {block.words} <<'FILE'\n{text}FILE"
        elif block.language == "sh":
            for line in text.splitlines():
                serves = line.startswith("skillc serve")
                yield line.removesuffix("&") + f"--bind 127.0.0.1:{port} &" if serves else line
                yield "until_ready" if serves else ""
        elif block.language == "python":
            yield f"python - <<'PYTHON'\n{text}PYTHON"
        else:
            yield f'echo "{MARK} {number}"'


def run_script(script: str, folder: Path) -> str:
    """Run a script of bash in a folder, and return what it printed; all that it has started ends with it."""
    path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
    environment = {**os.environ, "PATH": path, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with (folder / "printed").open("w+", encoding="utf-8") as printed:
        shell = subprocess.Popen(
            ("bash", "-c", script),
            cwd=folder,
            env=environment,
            stdout=printed,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            shell.wait(timeout=500.0)
        finally:
            with suppress(ProcessLookupError):
                os.killpg(shell.pid, signal.SIGKILL)
        printed.seek(0)
        return printed.read()


def check_output(printed: str, expected: str) -> None:
    """Check that each line of `expected` is part of a line that was printed, in order; `..` stands for any text."""
    place = 0
    for line in expected.splitlines():
        pattern = r"[^\n]*".join(map(re.escape, line.strip().split("..")))
        found = re.compile(pattern).search(printed, place)
        assert found is not None, f"not printed: {line}\n{printed}"
        place = found.end()
