"""`skillc run` with primitives that block, leave or kill its process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from dataclasses import dataclass
from itertools import cycle
from pathlib import Path

import pytest

from operating.terminal import Terminal
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.reader import TraceReader
from waiting import wait_until

LIBRARY = Path(__file__).with_name("blocking.skill")
BLOCKED, GONE = "no tick ended within 5 s, so its process was ended, in ", "its process ended without notice, in "
SWING = "Swing[slowly] (blocking.skill:13) and "


@dataclass(frozen=True)
class Case:
    """A task, and the exit code of its process, its end and the beginning of its failure."""

    task: str
    code: int
    status: str
    failure: str


CASES = (
    Case("sleep", 3, "interrupted", f"{BLOCKED}{SWING}Break[sleeping] (blocking.skill:22)"),
    Case("lock", 3, "interrupted", f"{BLOCKED}{SWING}Break[locking] (blocking.skill:26)"),
    Case("match", 3, "interrupted", f"{BLOCKED}Break[matching] (blocking.skill:30)"),
    Case("leave", 0, "interrupted", f"{GONE}Break[leaving] (blocking.skill:34)"),
    Case("exit", 3, "failed", "SystemExit: "),
    Case("kill", -signal.SIGKILL, "interrupted", f"{GONE}Break[killed] (blocking.skill:42)"),
)


@pytest.mark.sim
@pytest.mark.parametrize(
    ("case", "backend"), list(zip(CASES, cycle(("mujoco", "kinematic")))), ids=[case.task for case in CASES]
)
def test_whatever_a_primitive_does_the_run_has_an_end(tmp_path: Path, backend: str, case: Case) -> None:
    command = ("run", f"{LIBRARY}:{case.task}", "--json", "--tick-timeout", "5", "--backend", backend)
    done = subprocess.run(
        (sys.executable, "-m", "skillc", *command, "--no-film", "--out", str(tmp_path)),
        capture_output=True,
        text=True,
        timeout=300,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
        check=False,
    )
    result = json.loads(done.stdout)
    *_, ended = TraceReader(tmp_path / "events.jsonl").events
    assert done.returncode == case.code, done.stderr
    assert isinstance(ended, TaskEnded) and ended.failure is not None
    assert (result["status"], ended.status) == (case.status, case.status)
    assert result["failure"].startswith(case.failure) and result["failure"].startswith(ended.failure.message)
    assert result["sim_time_s"] > 0.0
    assert json.loads((tmp_path / "result.json").read_text(encoding="utf-8")) == result
    assert ended.failure.message in (tmp_path / "report.html").read_text(encoding="utf-8")


@pytest.mark.sim
def test_a_terminal_that_keys_were_read_from_is_as_it_was(tmp_path: Path) -> None:
    """The pace leaves it five seconds to show the keys in: once nothing else can run, they are not shown any more."""
    options = ("--tick-timeout", "5", "--backend", "kinematic", "--pace", "0.1", "--no-film", "--out", str(tmp_path))
    command = ("run", f"{LIBRARY}:lock", *options)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with Terminal((sys.executable, "-m", "skillc", *command), environment) as terminal:
        terminal.expect("q stop")
        wait_until(lambda: not terminal.echoes)
        assert terminal.wait() == 3
        assert terminal.modes == terminal.modes_before
