"""`skillc run` with primitives that block, leave or kill its process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.reader import TraceReader

pytestmark = pytest.mark.sim

LIBRARY = Path(__file__).with_name("blocking.skill")
BLOCKED, GONE = "no tick ended within 5 s, so its process was ended, in ", "its process ended without notice, in "
SWING = "Swing[slowly] (blocking.skill:13) and "


@pytest.mark.parametrize(
    ("task", "code", "status", "failure"),
    [
        ("sleep", 3, "interrupted", f"{BLOCKED}{SWING}Break[sleeping] (blocking.skill:22)"),
        ("lock", 3, "interrupted", f"{BLOCKED}{SWING}Break[locking] (blocking.skill:26)"),
        ("match", 3, "interrupted", f"{BLOCKED}Break[matching] (blocking.skill:30)"),
        ("leave", 0, "interrupted", f"{GONE}Break[leaving] (blocking.skill:34)"),
        ("exit", 3, "failed", "SystemExit: "),
        ("kill", -signal.SIGKILL, "interrupted", f"{GONE}Break[killed] (blocking.skill:42)"),
    ],
)
def test_whatever_a_primitive_does_the_run_has_an_end(
    tmp_path: Path, task: str, code: int, status: str, failure: str
) -> None:
    command = ("run", f"{LIBRARY}:{task}", "--json", "--tick-timeout", "5", "--out", str(tmp_path))
    done = subprocess.run(
        (sys.executable, "-m", "skillc", *command),
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        check=False,
    )
    result = json.loads(done.stdout)
    *_, ended = TraceReader(tmp_path / "events.jsonl").events
    assert done.returncode == code, done.stderr
    assert isinstance(ended, TaskEnded) and ended.failure is not None
    assert (result["status"], ended.status) == (status, status)
    assert result["failure"].startswith(failure) and result["failure"].startswith(ended.failure.message)
    assert result["sim_time_s"] > 0.0
    assert json.loads((tmp_path / "result.json").read_text(encoding="utf-8")) == result
    assert ended.failure.message in (tmp_path / "report.html").read_text(encoding="utf-8")
