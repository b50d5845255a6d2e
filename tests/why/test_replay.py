"""`skillc replay`: a recorded run is shown as it was, at a pace, and its user pauses and steps what is shown."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import skillc as api
from execution.test_repeat import recording
from operating.terminal import Terminal
from skillc.cli.main import skillc
from skillc_runtime.recording.events import NodeStarted, TaskEnded
from why.stories import written

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "CI": ""}


@pytest.fixture
def run(tmp_path: Path) -> Path:
    return written(tmp_path / "run", recording())


def replay(*arguments: object) -> Result:
    result = CliRunner().invoke(skillc, ["replay", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_without_a_terminal_the_calls_are_listed_in_their_order(run: Path) -> None:
    result = replay(run, "--pace", "fast")
    calls = [each for each in recording() if isinstance(each, NodeStarted) and each.kind == "call"]
    shown = [line for line in result.stderr.splitlines() if " s  " in line]
    assert result.exit_code == 0
    assert [line.rpartition("  ")[2].partition(" ")[0] for line in shown] == [each.name for each in calls]
    assert "finished, not verified" in result.stdout
    assert "planning again:" in result.stderr and "another plan was requested" in " ".join(result.stderr.split())


def test_a_replay_takes_the_time_of_its_cell_at_its_pace(run: Path) -> None:
    events = api.open_run(run)
    end = events.events[-1].cell_time_s - events.events[0].cell_time_s
    began = time.monotonic()
    assert tuple(events.replay(pace=2 * end)) == events.events
    assert time.monotonic() - began >= 0.3
    assert isinstance(events.events[-1].event, TaskEnded)


@pytest.mark.parametrize("pace", [0.0, -1.0, float("nan")])
def test_a_pace_is_positive(run: Path, pace: float) -> None:
    with pytest.raises(api.RequestError, match="the pace of a replay is positive"):
        api.open_run(run).replay(pace)


@pytest.mark.slow
def test_keys_pause_and_step_a_replay(run: Path) -> None:
    command = (sys.executable, "-m", "skillc", "replay", str(run), "--pace", "0.1")
    with Terminal(command, ENVIRONMENT) as terminal:
        terminal.expect(r"0\.\d s  Go\s+.*p pause  q stop  \+ - pace: 0\.1")
        terminal.type("p")
        terminal.expect(r"paused since .*: the replay pauses.*in    Go .*i step into  c continue  q stop")
        for _ in range(2):
            terminal.type("i")
            terminal.expect(r"(in  |next)  (Load|Go|Unload)")
        terminal.type("q")
        assert terminal.wait() == 0
        assert terminal.modes == terminal.modes_before


def test_a_library_is_for_checks_only(run: Path) -> None:
    result = replay(run, "--library", run)
    assert result.exit_code == 2 and "--library is for --check" in result.stderr


def test_json_is_the_result(run: Path) -> None:
    assert '"status": "succeeded"' in replay(run, "--json").stdout
