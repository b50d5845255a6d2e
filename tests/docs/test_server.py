"""Whoever types the session of the page on serving cells, in a shell, gets what it shows."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from docs.pages import ROOT, Block, blocks

PAGE = ROOT / "docs/server.md"
SESSION = "\n## A session\n"
MARK = "=== block"
SETUP = """set -m
trap 'kill -9 $(jobs -p) 2>/dev/null' EXIT
until_ready() {{
    for _ in $(seq 300); do
        [ "$(skillc ps 2>/dev/null | grep -c operational)" = 2 ] && return
        sleep 0.2
    done
    echo the server is not ready; exit 1
}}
export SKILLC_SERVER=http://127.0.0.1:{port}
"""


def write_script(session: Iterator[Block], port: int) -> Iterator[str]:
    """Yield the lines of the session as a script of bash, which waits until a server is ready as a person would."""
    yield SETUP.format(port=port)
    for number, block in enumerate(session):
        if block.language == "sh":
            for line in block.text.replace("8421", str(port)).splitlines():
                serves = line.startswith("skillc serve")
                yield line.removesuffix("&") + f"--bind 127.0.0.1:{port} &" if serves else line
                yield "until_ready" if serves else ""
        elif block.language == "python":
            yield f"{sys.executable} - <<'PYTHON'\n{block.text}PYTHON"
        elif block.language == "skill":
            yield f"cat > {block.words} <<'SKILL'\n{block.text}SKILL"
        else:
            yield f'echo "{MARK} {number}"'


def follow_session(folder: Path) -> int:
    """Run the session in a folder, and return how many of its outputs are as the page says."""
    (folder / "page.md").write_text(PAGE.read_text("utf-8").partition(SESSION)[2], "utf-8")
    session = tuple(blocks(folder / "page.md"))
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
    environment = {**os.environ, "PATH": path, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    shell = subprocess.Popen(
        ("bash", "-c", "\n".join(write_script(iter(session), port))),
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        printed = shell.communicate(timeout=500.0)[0]
    finally:
        shell.send_signal(signal.SIGTERM)
    expected = [each.text for each in session if each.language == "text"]
    parts = re.split(rf"^{MARK} \d+\n", printed, flags=re.MULTILINE)
    assert len(parts) == len(expected) + 1, printed
    for part, text in zip(parts, expected, strict=False):
        check_output(part, text)
    return len(expected)


def check_output(printed: str, expected: str) -> None:
    """Check that each line of `expected` is part of a line that was printed, in order; `..` stands for any text."""
    place = 0
    for line in expected.splitlines():
        pattern = r"[^\n]*".join(map(re.escape, line.strip().split("..")))
        found = re.compile(pattern).search(printed, place)
        assert found is not None, f"not printed: {line}\n{printed}"
        place = found.end()


@pytest.mark.sim
def test_the_session_goes_as_it_says(tmp_path: Path) -> None:
    assert follow_session(tmp_path) == 8
