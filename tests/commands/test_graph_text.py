"""`skillc graph` draws text for people in a terminal, and SVG for files."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc_dsl.rendering.printable import printable

pytestmark = pytest.mark.slow


def graph(*arguments: str, columns: int = 60, stdout: int = subprocess.PIPE) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable, "-m", "skillc", "graph", "wiping", "Wipe", *arguments]
    return subprocess.run(command, check=True, env={**os.environ, "COLUMNS": str(columns)}, stdout=stdout)


def test_a_terminal_gets_text_and_a_file_gets_svg() -> None:
    here, there = pty.openpty()
    graph(stdout=there)
    os.close(there)
    shown = b""
    while part := _read(here):
        shown += part
    lines = shown.decode().splitlines()
    assert any("skill Wipe" in line for line in lines) and any("└─▶ Inspect" in line for line in lines)
    assert all(len(line) <= 60 and line == printable(line) for line in lines)
    assert graph().stdout.startswith(b"<?xml")


def test_a_file_for_text_has_text(tmp_path: Path) -> None:
    graph("-o", str(tmp_path / "wipe.txt"))
    assert "├─◇ impl wipe_lanes of Wipe" in (tmp_path / "wipe.txt").read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("wiping", "Rinse"), "there is no skill or task `Rinse` in wiping; there is ActuateGripper, "),
        (("wiping", "Wipee"), "there is no skill or task `Wipee` in wiping; did you mean `Wipe`?"),
        (("wiping", "Wipe", "--plan"), "`Wipe` is a skill, and plans are for goals of tasks; draw it without --plan"),
    ],
)
def test_what_cannot_be_drawn_is_told(arguments: tuple[str, ...], message: str) -> None:
    result = CliRunner().invoke(skillc, ["graph", *arguments])
    assert result.exit_code == 2
    assert result.stderr.startswith(f"error: {message}")


def _read(terminal: int) -> bytes:
    try:
        return os.read(terminal, 65536)
    except OSError:  # the other end is closed
        return b""
