"""Trials on executors: what goes wrong in a process costs one trial, and no process outlives its parent."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any
from unittest.mock import ANY

import pytest

from skillc_runtime.evaluation.trials import hosting
from skillc_runtime.evaluation.trials.dispatch import Dispatch, ExecutorError, run_on
from skillc_runtime.evaluation.trials.hosting import Case, Prepare
from skillc_runtime.evaluation.trials.settings import Setting
from skillc_runtime.evaluation.trials.trial import TRIAL_LIMIT_S, Trial
from trials.runners import BROKEN, KILLED, Echoing, Exits, FailsOnce, Faulty, Slow, Unprepared, Vanishes, Waits, good
from waiting import wait_until

TESTS = Path(__file__).parents[1]
PARENT = """
from concurrent.futures import {kind}
from functools import partial
from pathlib import Path
from skillc_runtime.evaluation.trials.dispatch import run_on
from trials.runners import Endless

if __name__ == "__main__":
    with {kind}(2) as executor:
        for tried in run_on(executor, partial(Endless, Path({folder!r})), range(2)):
            pass
"""


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def run(prepare: Prepare, seeds: Sequence[int], limit_s: float = TRIAL_LIMIT_S) -> list[Trial]:
    """Run trials on two threads, as `--jobs 2` does."""
    with ThreadPoolExecutor(2) as executor:
        return [tried.trial for tried in run_on(executor, prepare, seeds, limit_s)]


class Twice(ThreadPoolExecutor):
    """Runs every call twice, as an executor may that has lost sight of a worker, and takes the second result."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        super().submit(fn, *args, **kwargs)
        return super().submit(fn, *args, **kwargs)


class GivesUp(ThreadPoolExecutor):
    """Cancels what it is given."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.cancel()
        return future


@pytest.mark.parametrize("kind", [ThreadPoolExecutor, ProcessPoolExecutor, Twice])
def test_every_seed_has_its_trial_whatever_happens_to_a_process(kind: Callable[[int], Executor]) -> None:
    with kind(2) as executor:
        found = [tried.trial for tried in run_on(executor, Faulty, [*range(7), 0, 5])]
    trials = {trial.seed: trial for trial in found}
    assert sorted(trials) == list(range(7)) and len(found) == 7
    assert all(trials[seed] == good(seed) for seed in trials if seed not in (KILLED, BROKEN))
    why = "its process ended with signal 9, in 3 of 3 attempts"
    assert (trials[KILLED].status, trials[KILLED].reason) == ("crashed", why)
    assert trials[BROKEN].status == "crashed"
    assert (trials[BROKEN].reason or "").startswith("ArithmeticError: nothing adds up (runners.py:")


@pytest.mark.slow
def test_a_trial_that_takes_too_long_is_ended_and_the_others_go_on(tmp_path: Path) -> None:
    trials = {trial.seed: trial for trial in run(partial(Slow, tmp_path), range(4), limit_s=3.0)}
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
def test_processes_that_die_at_their_start_end_the_series(prepare: Prepare, why: str) -> None:
    with pytest.raises(ExecutorError) as error:
        run(prepare, range(50))
    assert str(error.value).startswith(f"the worker on {socket.gethostname()} cannot run the trials: {why}")


def test_a_preparation_that_never_ends_ends_the_series(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hosting, "PREPARATION_LIMIT_S", 0.1)
    with pytest.raises(ExecutorError, match=r"it took longer than 0\.1 s"):
        run(partial(Waits, 600.0), range(5))


def test_seeds_of_a_process_that_cannot_start_are_run_by_others(tmp_path: Path) -> None:
    trials = run(partial(FailsOnce, tmp_path), range(6))
    assert sorted(trial.seed for trial in trials) == list(range(6))
    assert all(trial == good(trial.seed) for trial in trials)
    assert len(list(tmp_path.iterdir())) > 1


def test_no_seeds_need_no_process() -> None:
    assert run(Faulty, ()) == []


def test_a_worker_with_another_version_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    versions = iter(["0.2 of 12", *["0.1 of 34"] * 9])
    monkeypatch.setattr(hosting, "identify_skillc", lambda: next(versions))
    with pytest.raises(ExecutorError, match=r"the worker on .* has skillc 0\.1 of 34, here it is 0\.2 of 12; install"):
        run(Faulty, range(3))


def test_an_executor_that_gives_up_or_has_ended_ends_the_series() -> None:
    ended = ThreadPoolExecutor(1)
    ended.shutdown()
    for executor, why in ((GivesUp(1), "has given the trials up"), (ended, "takes no more trials: cannot schedule")):
        with pytest.raises(ExecutorError, match=f"the executor {why}"):
            list(run_on(executor, Faulty, range(3)))


def test_processes_that_wait_for_trials_end_after_a_while(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hosting, "IDLE_S", 0.1)
    order = hosting.make_order(Faulty, TRIAL_LIMIT_S)
    assert hosting.run_trial(order, hosting.Case(1)) == hosting.Tried(good(1), ANY)
    ((child, _),) = hosting._idle
    # Its files are deleted after it has ended, by the thread that ended it.
    wait_until(lambda: not (hosting._idle or alive(child._process.pid) or Path(child._files.name).exists()))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "number"),
    [
        ("ThreadPoolExecutor", signal.SIGKILL),
        ("ThreadPoolExecutor", signal.SIGINT),
        ("ThreadPoolExecutor", signal.SIGTERM),
    ],
)
def test_no_process_outlives_its_parent(kind: str, number: signal.Signals, tmp_path: Path) -> None:
    file, pids = tmp_path / "parent.py", tmp_path / "pids"
    file.write_text(PARENT.format(kind=kind, folder=str(pids)), encoding="utf-8")
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


def test_a_case_is_run_with_its_settings() -> None:
    speeds = [Setting("Wipe.wipe_lanes", "speed", 0.1 * number) for number in range(1, 4)]
    with ThreadPoolExecutor(2) as executor, Dispatch(executor, Echoing) as dispatch:
        for speed in speeds:
            dispatch.give(Case(7, (speed,)))
        found = dict(dispatch.take() for _ in speeds)
    assert {case: tried.trial.reason for case, tried in found.items()} == {
        Case(7, (speed,)): f"speed of Wipe.wipe_lanes is {speed.value}" for speed in speeds
    }
