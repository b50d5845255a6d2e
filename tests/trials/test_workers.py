"""Processes that run trials: what goes wrong in one costs one trial, and none outlives its parent."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from skillc_runtime.evaluation.trials.workers import PreparationError, Runner, run_in_processes
from trials.runners import BROKEN, KILLED, Exits, FailsOnce, Faulty, Slow, Unprepared, Vanishes, Waits, good

TESTS = Path(__file__).parents[1]
PARENT = """
from functools import partial
from pathlib import Path
from skillc_runtime.evaluation.trials.workers import run_in_processes
from trials.runners import Endless

if __name__ == "__main__":
    for trial in run_in_processes(partial(Endless, Path({folder!r})), range(2), 2):
        pass
"""


def wait_until(condition: Callable[[], bool], most_s: float = 60.0) -> None:
    end = time.monotonic() + most_s
    while not condition():
        assert time.monotonic() < end, "it does not come about"
        time.sleep(0.02)


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_every_seed_has_its_trial_whatever_happens_to_a_process() -> None:
    trials = {trial.seed: trial for trial in run_in_processes(Faulty, range(7), 2)}
    assert sorted(trials) == list(range(7))
    assert all(trials[seed] == good(seed) for seed in trials if seed not in (KILLED, BROKEN))
    assert (trials[KILLED].status, trials[KILLED].reason) == ("crashed", "its process ended with signal 9")
    assert trials[BROKEN].status == "crashed"
    assert (trials[BROKEN].reason or "").startswith("ArithmeticError: nothing adds up (runners.py:")


@pytest.mark.slow
def test_a_trial_that_takes_too_long_is_ended_and_the_others_go_on(tmp_path: Path) -> None:
    trials = {trial.seed: trial for trial in run_in_processes(partial(Slow, tmp_path), range(4), 2, limit_s=3.0)}
    assert sorted(trials) == list(range(4))
    assert (trials[BROKEN - 2].status, trials[BROKEN - 2].reason) == ("crashed", "it took longer than 3 s")
    assert all(trials[seed] == good(seed) for seed in trials if seed != BROKEN - 2)


@pytest.mark.parametrize(
    ("prepare", "why"),
    [
        (Exits, "its process ended with code 5"),
        (Unprepared, "FileNotFoundError: there is no scene (runners.py:"),
        (Vanishes, "its process ended with signal 9"),
    ],
)
def test_processes_that_die_at_their_start_end_the_series(prepare: Callable[[], Runner], why: str) -> None:
    with pytest.raises(PreparationError) as error:
        list(run_in_processes(prepare, range(50), 2))
    assert str(error.value).startswith(why)


def test_a_preparation_that_never_ends_ends_the_series(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("skillc_runtime.evaluation.trials.workers.PREPARATION_LIMIT_S", 0.1)
    with pytest.raises(PreparationError, match=r"it took longer than 0\.1 s"):
        list(run_in_processes(partial(Waits, 600.0), range(5), 2))


def test_seeds_of_a_process_that_cannot_start_are_run_by_others(tmp_path: Path) -> None:
    trials = list(run_in_processes(partial(FailsOnce, tmp_path), range(6), 2))
    assert sorted(trial.seed for trial in trials) == list(range(6))
    assert all(trial == good(trial.seed) for trial in trials)
    assert len(list(tmp_path.iterdir())) > 1


def test_no_seeds_need_no_process() -> None:
    assert list(run_in_processes(Faulty, (), 2)) == []


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_no_process_outlives_its_parent(number: signal.Signals, tmp_path: Path) -> None:
    file, pids = tmp_path / "parent.py", tmp_path / "pids"
    file.write_text(PARENT.format(folder=str(pids)), encoding="utf-8")
    pids.mkdir()
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(TESTS), *sys.path])}
    parent = subprocess.Popen([sys.executable, file], env=environment, stderr=subprocess.DEVNULL)
    try:
        wait_until(lambda: len(list(pids.iterdir())) == 2)
        parent.send_signal(number)
        parent.wait()
    finally:
        parent.kill()
    children = [int(each.name) for each in pids.iterdir()]
    wait_until(lambda: not any(map(alive, children)))
