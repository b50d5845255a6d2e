"""However a run ends, its recording and its result have an end, and nothing of it is left."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import msgspec
import numpy as np
import pytest

from ends import run_by_the_clock, run_to_end
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.motion.numerics.compiled import COMPILES
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.reader import TraceReader

BLOCKED = "no tick ended within 1 s, so its process was ended"
GONE = "its process ended without notice"


def run(
    folder: Path, how: str, timeout_s: float = 1.0, program: ModuleType = run_to_end
) -> subprocess.CompletedProcess[str]:
    """Run a program to its end, and that of its watchdog, which holds the same pipes."""
    (folder / "tmp").mkdir()
    environment = {**os.environ, "TMPDIR": str(folder / "tmp"), "PYTHONPATH": os.pathsep.join(sys.path)}
    if program is run_to_end:
        environment["SKILLC_CACHE"] = str(folder / "cache")  # one of them has to compile
    command = (sys.executable, str(program.__file__), str(folder / "out"), str(timeout_s), how)
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=300, check=False)
    assert not list((folder / "tmp").iterdir()), "a temporary folder is left"
    return done


def read_end(folder: Path) -> TaskEnded:
    """Return the last event of a recording."""
    *_, last = TraceReader(folder / "out/events.jsonl").events
    assert isinstance(last, TaskEnded)
    return last


def read_result(folder: Path) -> TaskResult:
    return msgspec.json.decode((folder / "out/result.json").read_bytes(), type=TaskResult)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("how", "code", "why"),
    [
        ("sleep", 3, BLOCKED),
        pytest.param("lock", 3, BLOCKED, marks=pytest.mark.sim),
        pytest.param("match", 3, BLOCKED, marks=pytest.mark.sim),
        pytest.param("ignore", -signal.SIGKILL, BLOCKED, marks=pytest.mark.sim),
        pytest.param("leave", 0, GONE, marks=pytest.mark.sim),
        ("kill", -signal.SIGKILL, GONE),
        pytest.param("crash", -signal.SIGSEGV, GONE, marks=pytest.mark.sim),
        pytest.param("hang up", -signal.SIGHUP, GONE, marks=pytest.mark.sim),
    ],
)
def test_the_end_of_a_process_that_cannot_write_it_is_written(tmp_path: Path, how: str, code: int, why: str) -> None:
    done = run(tmp_path, how)
    message = f"{why}, in Act[way] (play.skill:3)"
    ended, result = read_end(tmp_path), read_result(tmp_path)
    assert done.returncode == code
    assert done.stderr == f"error: play was interrupted: {message}\n"
    assert (ended.status, ended.time) == ("interrupted", 0.2)
    assert ended.failure is not None and (ended.failure.kind, ended.failure.message) == ("interrupted", message)
    assert msgspec.json.decode(done.stdout, type=TaskResult) == result
    assert (result.status, result.failure, result.seed, result.sim_time_s) == ("interrupted", message, 7, 0.2)
    assert [(step.skill, step.status) for step in result.plan] == [("Outer", "running")]
    assert message in (tmp_path / "out/report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("how", "code", "why"),
    [
        pytest.param("exit", 0, "SystemExit: ", marks=pytest.mark.sim),
        ("error", 1, "ValueError: what was expected is missing"),
        pytest.param("interrupt", -signal.SIGINT, "it was interrupted twice", marks=pytest.mark.sim),
    ],
)
def test_the_end_of_a_run_that_is_broken_off_is_written(tmp_path: Path, how: str, code: int, why: str) -> None:
    done = run(tmp_path, how)
    ended = read_end(tmp_path)
    assert done.returncode == code
    assert ended.failure is not None and ended.failure.message == f"{why}, in Act[way] (play.skill:3)"
    assert ended.status == read_result(tmp_path).status == "interrupted"


@pytest.mark.early
@pytest.mark.parametrize(
    "how", ["finish", *(pytest.param(how, marks=pytest.mark.sim) for how in ("report", "suspend", "compile"))]
)
def test_a_run_that_may_take_its_time_is_not_ended(tmp_path: Path, how: str) -> None:
    if how == "compile" and not COMPILES:
        pytest.skip("needs numba")
    done = run(tmp_path, how, timeout_s=5.0)
    compiling = "compiling the control laws, once for this version, for about 20 s\n" if how == "compile" else ""
    assert (done.returncode, done.stdout, done.stderr) == (0, "", compiling)
    assert read_end(tmp_path).status == "succeeded"
    assert not (tmp_path / "out/result.json").exists(), "it is written by what follows the run"


@pytest.mark.sim
def test_a_process_that_dies_after_the_end_of_the_run_changes_nothing_in_it(tmp_path: Path) -> None:
    done = run(tmp_path, "die in the report")
    assert done.stderr == f"warning: play had succeeded: {GONE}, before its report was written\n"
    assert read_end(tmp_path).status == "succeeded"
    assert (read_result(tmp_path).status, read_result(tmp_path).verified) == ("succeeded", True)


@pytest.mark.parametrize(
    ("how", "stops"),
    [
        pytest.param("sleep", True, marks=pytest.mark.sim),
        pytest.param("lock", False, marks=pytest.mark.sim),
        pytest.param("alive", True, marks=pytest.mark.sim),
    ],
)
def test_devices_with_a_control_thread_have_stopped_when_the_process_ends(
    tmp_path: Path, how: str, stops: bool
) -> None:
    done = run(tmp_path, how, 3.0, run_by_the_clock)
    rows = np.load(tmp_path / "out" / run_by_the_clock.JOINTS)
    joints = rows[np.isfinite(rows[:, 0])]
    moved = np.abs(np.diff(joints, axis=0)).max(axis=1)
    assert done.returncode == 3, done.stderr
    assert read_end(tmp_path).status == read_result(tmp_path).status == "interrupted"
    assert moved.max() > 2e-5, "the arm moved"
    assert (moved[-50:].max() < 1e-9) == stops, "without the interpreter lock the control thread does nothing more"
