"""A run in a terminal: it is paused, looked at, stepped, continued, suspended and stopped by keys."""

from __future__ import annotations

import json
import os
import shlex
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from operating.depot import line_of, write_depot
from operating.terminal import Terminal
from skillc_runtime.recording.events import Event, NodeStarted, Requested, StateChanged, TaskEnded
from skillc_runtime.recording.reader import TraceReader
from waiting import wait_until

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
LIFT, CARRY, LOWER = (f"depot.skill:{line_of(f'    {name}()')}" for name in ("Lift", "Carry", "Lower"))


def command(folder: Path, *options: str, far_s: int = 2000) -> tuple[str, ...]:
    """Return the command that runs the delivery; its recording is written to the folder `out` in a folder."""
    place = write_depot(folder, far_s)
    given = ("--call", "Deliver()", "--no-film", "--out", str(folder / "out"))
    return (sys.executable, "-m", "skillc", "run", *place, *given, *options)


def read_events(folder: Path) -> list[Event]:
    return list(TraceReader(folder / "out/events.jsonl").events)


def test_a_task_is_stepped_paused_and_continued_to_its_end(tmp_path: Path) -> None:
    with Terminal(command(tmp_path, "--step", far_s=20), ENVIRONMENT) as terminal:
        terminal.expect(r"paused since \d+\.\d s: step: Deliver is next\s+next  Deliver  call:1\s+s step over")
        wait_until(lambda: not terminal.echoes)
        terminal.type("i")
        terminal.expect(rf"step: Lift is next\s+next  Lift     {LIFT}\s+Deliver  ")
        terminal.type("s")
        terminal.expect(rf"step: Carry is next\s+next  Carry    {CARRY}")
        terminal.type("p")
        terminal.expect(r"p \(pause\) is not possible while the task is paused; possible: s step over, i step into")
        terminal.type("c")
        assert terminal.wait() == 0
        assert terminal.modes == terminal.modes_before
    events = read_events(tmp_path)
    asked = [(event.command.name, bool(event.refused)) for event in events if isinstance(event, Requested)]
    assert asked == [("step-into", False), ("step-over", False), ("pause", True), ("resume", False)]
    assert [event.name for event in events if isinstance(event, NodeStarted) and event.kind == "call"] == [
        "Deliver", "Lift", "Carry", "Lower",
    ]  # fmt: skip
    assert isinstance(events[-1], TaskEnded) and events[-1].status == "succeeded"


def test_each_step_waits_for_enter_and_a_letter_stops(tmp_path: Path) -> None:
    with Terminal(command(tmp_path, "--confirm-steps", far_s=20), ENVIRONMENT) as terminal:
        terminal.expect(r"paused since \d+\.\d s: Deliver is to be confirmed\s+next  Deliver  call:1")
        terminal.expect(r"Enter go on  s stop")
        terminal.type("i\n")
        assert terminal.wait() == 0
    with Terminal(command(tmp_path, "--confirm-steps"), ENVIRONMENT) as terminal:
        terminal.expect("Deliver is to be confirmed")
        terminal.type("s")
        assert terminal.wait() == 3
        assert "stopped by the user" in terminal.shown
    assert not [event for event in read_events(tmp_path) if isinstance(event, NodeStarted) and event.name == "Lift"]


def test_a_task_pauses_at_breakpoints_and_after_what_is_around_a_call(tmp_path: Path) -> None:
    places = ("--breakpoints", "Lift", "--breakpoints", f"depot.skill:{LOWER.partition(':')[2]}")
    with Terminal(command(tmp_path, *places, far_s=20), ENVIRONMENT) as terminal:
        terminal.expect(rf"breakpoint at Lift\s+next  Lift     {LIFT}")
        terminal.type("c")
        terminal.expect(rf"breakpoint at {LOWER}\s+next  Lower    {LOWER}")
        terminal.type("o")
        assert terminal.wait() == 0


def test_a_task_that_runs_is_paused_and_stopped(tmp_path: Path) -> None:
    with Terminal(command(tmp_path, "--pace", "real"), ENVIRONMENT) as terminal:
        terminal.expect(r"Deliver > Carry\s+p pause  q stop  \+ - pace: real")
        terminal.type("-")
        terminal.expect(r"pace: 0\.5")
        terminal.type("s")
        terminal.expect(r"s \(step over\) is not possible while the task is running; possible: p pause, q stop")
        terminal.type("p")
        terminal.expect(rf"paused since \d+\.\d s: requested\s+in    Carry    {CARRY}\s+Deliver  ")
        terminal.type("q")
        assert terminal.wait() == 3
        assert "stopped by the user" in terminal.shown
        assert terminal.modes == terminal.modes_before
    events = read_events(tmp_path)
    states = [event.state for event in events if isinstance(event, StateChanged)]
    assert states[-3:] == ["pausing", "paused", "stopping"]
    assert isinstance(events[-1], TaskEnded) and events[-1].status == "stopped"
    assert json.loads((tmp_path / "out/result.json").read_text(encoding="utf-8"))["status"] == "stopped"


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (signal.SIGINT, "interrupted"),
        pytest.param(signal.SIGTERM, "ended by SIGTERM", marks=pytest.mark.sim),
        pytest.param(signal.SIGHUP, "ended by SIGHUP", marks=pytest.mark.sim),
    ],
)
def test_a_signal_stops_a_task_and_the_terminal_is_as_it_was(tmp_path: Path, number: signal.Signals, said: str) -> None:
    with Terminal(command(tmp_path, "--pace", "real"), ENVIRONMENT) as terminal:
        terminal.expect("Deliver > Carry")
        terminal.send(number)
        assert terminal.wait() == 3
        assert said in terminal.shown
        assert terminal.modes == terminal.modes_before
    *_, ended = read_events(tmp_path)
    assert isinstance(ended, TaskEnded) and ended.failure is not None
    assert (ended.status, ended.failure.message) == ("stopped", said)


@pytest.mark.sim
def test_a_suspended_run_leaves_the_terminal_to_the_shell_and_goes_on(tmp_path: Path) -> None:
    run = shlex.join(command(tmp_path, "--pace", "real"))
    script = f"set -m; {run}; echo suspended; read line; echo got $line; fg; echo code $?"
    with Terminal(("bash", "-c", script), ENVIRONMENT) as terminal:
        terminal.expect("Deliver > Carry")
        terminal.type("\x1a")
        terminal.expect("suspended")
        assert terminal.modes == terminal.modes_before
        terminal.type("words\n")
        terminal.expect(r"got words.*Deliver > Carry")
        wait_until(lambda: not terminal.echoes)
        terminal.type("q")
        terminal.expect("code 3")
        assert terminal.wait() == 0
        assert terminal.modes == terminal.modes_before


def test_a_run_in_the_background_takes_no_keys_from_the_shell(tmp_path: Path) -> None:
    run = shlex.join(command(tmp_path, "--pace", "real"))
    script = f"set -m; {run} 2>{tmp_path}/err & read line; echo got $line; kill -TERM %1; wait %1; echo code $?"
    with Terminal(("bash", "-c", script), ENVIRONMENT) as terminal:
        terminal.type("words\n")
        terminal.expect("got words")
        terminal.expect("code (3|143)")
        assert terminal.wait() == 0


@pytest.mark.parametrize("option", [("--step",), pytest.param(("--breakpoints", "Lift"), marks=pytest.mark.sim)])
def test_without_a_terminal_nothing_may_pause(tmp_path: Path, option: tuple[str, ...]) -> None:
    done = subprocess.run(command(tmp_path, *option), env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert f"{option[0]} requires a terminal that shows the run and takes keys" in done.stderr
    assert "stderr is not a terminal" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("option", "environment", "said"),
    [
        ("--json", {}, "--step cannot be used with --json, which shows no run and takes no keys"),
        ("--quiet", {}, "--quiet is given: nobody could let the task go on after a pause"),
        ("--step", {"CI": "true"}, "the environment variable CI is set: nobody could let the task go on after a pause"),
    ],
)
def test_nothing_may_pause_without_a_display(
    tmp_path: Path, option: str, environment: dict[str, str], said: str
) -> None:
    with Terminal(command(tmp_path, "--step", option), {**ENVIRONMENT, **environment}) as terminal:
        assert terminal.wait() == 2
        assert said in " ".join(terminal.shown.split())
