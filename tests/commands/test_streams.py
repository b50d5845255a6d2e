"""Standard streams that are closed or full end a command with words and an exit code that tell the truth."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from waiting import LONG_S

MAIN = "from skillc.cli.main import main; main()"
FULL = "error: cannot write to the standard output: No space left on device\n"
CLOSED = "error: cannot write to the standard output: Bad file descriptor\n"
GOOD = 'skill Rest { noplan }\nimpl waiting of Rest { run python "skillc.primitives:StandIn" }\n'
NO_MESSAGE = b"Content-Length: 3\r\n\r\n[5]"


@pytest.fixture
def place(tmp_path: Path) -> Path:
    (tmp_path / "good.skill").write_text(GOOD)
    (tmp_path / "bad.skill").write_text("skill X { in a: Nope }\n")
    return tmp_path


def ended(place: Path, command: str, given: bytes = b"", **more: str) -> tuple[int, str]:
    """Run a command with redirections in a shell; return its exit code and what it says."""
    python = f'"{sys.executable}" -c "{MAIN}"'
    line = command.replace("skillc", python)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "TMPDIR": str(place), **more}
    done = subprocess.run(
        ["sh", "-c", line], cwd=place, input=given, env=environment, capture_output=True, timeout=LONG_S, check=False
    )
    assert not list(place.glob("skillc-crash-*"))
    # On a slow machine it is said after two seconds what is going on.
    return done.returncode, re.sub(r"^\w+ing \.\.\n", "", done.stderr.decode())


@pytest.mark.parametrize("command", ["--help", "explain", "check bad.skill --format concise"])
def test_a_full_output_is_said(place: Path, command: str) -> None:
    assert ended(place, f"skillc {command} > /dev/full") == (1, FULL)


def test_a_full_output_without_a_buffer_is_said(place: Path) -> None:
    assert ended(place, "skillc explain > /dev/full", PYTHONUNBUFFERED="1") == (1, FULL)


def test_a_closed_output_is_said_where_there_is_something_to_print(place: Path) -> None:
    assert ended(place, "skillc check bad.skill >&-") == (1, CLOSED)
    assert ended(place, "skillc check good.skill >&-") == (0, "no problems\n")


@pytest.mark.slow
@pytest.mark.parametrize("errors", ["2>&-", "2>/dev/full"])
def test_messages_that_nobody_takes_change_no_exit_code(place: Path, errors: str) -> None:
    assert ended(place, f"skillc plan nowhere:x {errors}") == (2, "")
    assert ended(place, f"skillc check bad.skill > /dev/full {errors}") == (1, "")


def test_a_closed_input_is_empty(place: Path) -> None:
    assert ended(place, "skillc fmt - <&-") == (0, "")


@pytest.mark.slow
@pytest.mark.parametrize(
    "given",
    [
        b"Content-Length: 99999999999\r\n\r\n{",
        b"Content-Length: " + b"9" * 5000 + b"\r\n\r\n{",
        b"Content-Length: -1\r\n\r\n{",
        b"hello\n",
    ],
)
def test_what_no_editor_sends_is_refused_in_words(place: Path, given: bytes) -> None:
    code, said = ended(place, "skillc lsp", given)
    assert code == 1 and said.startswith("error: ") and said.count("\n") == 1


def test_json_that_is_no_message_is_left_out(place: Path) -> None:
    code, said = ended(place, "skillc lsp > out", NO_MESSAGE)
    assert (code, said) == (1, "")
    assert "is not a JSON-RPC message" in (place / "out").read_text()


@pytest.mark.slow
@pytest.mark.parametrize(("output", "said"), [("> /dev/full", FULL), (">&-", CLOSED)])
def test_a_server_whose_editor_takes_nothing_ends(place: Path, output: str, said: str) -> None:
    assert ended(place, f"skillc lsp {output}", NO_MESSAGE) == (1, said)
