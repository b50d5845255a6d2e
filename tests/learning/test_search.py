"""Searching a study: it finds what is better, resumes, survives kills, and counts nothing twice."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from functools import partial
from importlib.util import find_spec
from itertools import islice
from pathlib import Path

import optuna
import pytest

from learning.runners import RADIUS, SPEED, Wiping, aim, open_study
from skillc.contract.learning import SamplerName
from skillc.errors import RequestError, ServiceError
from skillc.services.learning import study as studies
from skillc.services.learning.racing import Aim
from skillc.services.learning.result import choose, list_front, list_measured
from skillc.services.learning.samplers import require_sampler
from skillc.services.learning.search import Search, try_fresh
from skillc.services.learning.study import FILE, NAME, Study
from skillc_runtime.evaluation.trials.dispatch import Dispatch
from skillc_runtime.evaluation.trials.hosting import Prepare
from waiting import LONG_S

TESTS = Path(__file__).parents[1]
SEEDS = range(3)
BOTH = "time, force_rmse"


def search(
    study: Study, aim: Aim, wanted: int, prepare: Prepare = Wiping, parallel: int = 2, most: int | None = None
) -> None:
    """Search with processes, or stop after `most` trials."""
    study.use_sampler("tpe", wanted, 0)
    with ThreadPoolExecutor(parallel) as executor:
        steps = Search(study, aim, SEEDS, wanted, parallel).run(executor, prepare, 60.0)
        with closing(steps):
            for _ in islice(steps, most):
                pass


def read_notes(folder: Path) -> Counter[str]:
    return Counter((folder / "noted").read_text().splitlines())


@pytest.mark.slow
def test_it_finds_what_is_better_in_both_objectives(tmp_path: Path) -> None:
    wanted = aim(BOTH, "coverage == 100 %")
    with closing(open_study(tmp_path, 2, BOTH)) as study:
        search(study, wanted, 25)
        assert len(study.candidates) == 25
        assert study.candidates[0].values == (0.1, 15.0)
        assert all(each.verdict is not None for each in study.candidates.values())
        wide = [each for each in study.candidates.values() if each.values[1] >= 30.0]
        assert wide
        assert all(each.verdict == "infeasible" and len(each.worlds) == 1 for each in wide)
        assert all(set(each.worlds) == set(SEEDS) for each in list_measured(study.candidates).values())
        front = list_front(study.candidates, wanted)
        assert front
        chosen = choose(study.candidates, wanted)
        assert chosen is not None
        assert chosen in front
        least = aim("force_rmse").mean(study.candidates[chosen].worlds.values())
        known = aim("force_rmse").mean(study.candidates[0].worlds.values())
        assert least is not None
        assert known is not None
        assert least < known


@pytest.mark.slow
def test_a_study_goes_on_where_it_was(tmp_path: Path) -> None:
    notes, wanted = tmp_path / "notes", aim("time")
    notes.mkdir()
    with closing(open_study(tmp_path / "out", 1)) as study:
        search(study, wanted, 4, partial(Wiping, notes), parallel=1, most=4)
        before = {number: (each.values, dict(each.worlds)) for number, each in study.candidates.items()}
        assert sum(len(known) for _, known in before.values()) == 4
    with closing(open_study(tmp_path / "out", 1)) as study:
        assert {number: (each.values, each.worlds) for number, each in study.candidates.items()} == before
        search(study, wanted, 4, partial(Wiping, notes), parallel=1)
        search(study, wanted, 4, partial(Wiping, notes), parallel=1)  # nothing is missing
        done = sum(len(each.worlds) for each in study.candidates.values())
        assert len(study.candidates) == 4
    again = read_notes(notes)
    assert max(again.values()) <= 2  # that which ran when it was stopped
    assert done <= sum(again.values()) <= done + 1


@pytest.mark.slow
def test_fresh_worlds_are_tried_once(tmp_path: Path) -> None:
    wanted = aim("time")
    with closing(open_study(tmp_path, 1)) as study:
        search(study, wanted, 2, parallel=1)
        with ThreadPoolExecutor(1) as executor, Dispatch(executor, Wiping) as dispatch:
            assert len(list(try_fresh(study, (0, 1), range(3, 5), 1, dispatch))) == 4
            assert not list(try_fresh(study, (0, 1), range(3, 5), 1, dispatch))
    with closing(open_study(tmp_path, 1)) as study:
        assert {number: sorted(known) for number, known in study.fresh.items()} == {0: [3, 4], 1: [3, 4]}


@pytest.mark.slow
def test_a_process_that_dies_costs_its_candidate_alone(tmp_path: Path) -> None:
    with closing(open_study(tmp_path, 1)) as study:
        search(study, aim("time"), 8, partial(Wiping, None, 1))
        fast = [each for each in study.candidates.values() if each.values[0] > 0.1]
        slow = [each for each in study.candidates.values() if each.values[0] <= 0.1 and each.verdict == "measured"]
        assert fast
        assert slow
        assert all(each.verdict == "infeasible" for each in fast)
        assert all("signal 9" in each.worlds[1].failures[0] for each in fast)


KILLED = """
import sys
from contextlib import closing
from functools import partial
from pathlib import Path
from learning.runners import Wiping, aim, open_study
from learning.test_search import search

if __name__ == "__main__":
    with closing(open_study(Path(sys.argv[1]), 1)) as study:
        search(study, aim("time"), 40, partial(Wiping, Path(sys.argv[2])), parallel=2)
"""


@pytest.mark.slow
def test_a_coordinator_that_is_killed_loses_nothing(tmp_path: Path) -> None:
    out, notes = tmp_path / "out", tmp_path / "notes"
    notes.mkdir()
    environment = {**os.environ, "PYTHONPATH": f"{TESTS}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"}
    done = 0
    for round_ in range(3):
        process = subprocess.Popen((sys.executable, "-c", KILLED, out, notes), env=environment)
        end = time.monotonic() + LONG_S
        while not (notes / "noted").exists() or sum(read_notes(notes).values()) < 6 * (round_ + 1):
            assert time.monotonic() < end, "nothing is tried"
            time.sleep(0.02)
        os.kill(process.pid, signal.SIGKILL)
        process.wait(LONG_S)
        with closing(open_study(out, 1)) as study:
            now = sum(len(each.worlds) for each in study.candidates.values())
            assert now >= done
            done = now
    with closing(open_study(out, 1)) as study:
        search(study, aim("time"), len(study.candidates), partial(Wiping, notes))
        done = sum(len(each.worlds) for each in study.candidates.values())
        assert all(each.verdict is not None for each in study.candidates.values())
    made = sum(read_notes(notes).values())
    assert done <= made <= done + 3 * 2  # what ran at a kill is run again, and recorded once


def test_a_study_that_was_killed_when_it_was_made_is_made_anew(tmp_path: Path) -> None:
    optuna.create_study(study_name=NAME, storage=f"sqlite:///{tmp_path / FILE}", directions=["minimize"] * 3)
    with closing(open_study(tmp_path, 1)) as study:
        assert study.ask().values == (0.1, 15.0)
    with closing(open_study(tmp_path, 1)) as study:
        assert list(study.candidates) == [0]


def test_a_candidate_that_was_killed_when_it_was_asked_for_does_not_count(tmp_path: Path) -> None:
    with closing(open_study(tmp_path, 1)):
        pass
    half = optuna.load_study(study_name=NAME, storage=f"sqlite:///{tmp_path / FILE}").ask()
    half.suggest_float(SPEED.name, SPEED.low, SPEED.high, log=True)
    with closing(open_study(tmp_path, 1)) as study:
        assert not study.candidates
        assert study.ask().values == (0.1, 15.0)


@pytest.mark.slow
@pytest.mark.parametrize("sampler", ["nsga2", "random"])
def test_other_samplers_ask_for_candidates(tmp_path: Path, sampler: SamplerName) -> None:
    wanted = aim(BOTH)
    with closing(open_study(tmp_path, 2, BOTH)) as study:
        study.use_sampler(sampler, 12, 0)
        with ThreadPoolExecutor(2) as executor:
            for _ in Search(study, wanted, SEEDS, 12, 2).run(executor, Wiping, 60.0):
                pass
        assert len({each.values for each in study.candidates.values()}) > 6
        shares = study.compute_importances(1)
        assert set(shares) == {SPEED.name, RADIUS.name}
        assert sum(shares.values()) == pytest.approx(1.0)


@pytest.mark.skipif(find_spec("torch") is not None, reason="torch is installed")
def test_a_sampler_says_what_it_needs() -> None:
    with pytest.raises(RequestError, match="the sampler `gp` needs torch"):
        require_sampler("gp")


def test_a_study_of_something_else_is_not_mixed(tmp_path: Path) -> None:
    open_study(tmp_path, 1).close()
    with pytest.raises(ServiceError, match="is of another minimise: time, now it is force_rmse; take another folder"):
        open_study(tmp_path, 1, "force_rmse")


def test_two_processes_do_not_share_a_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studies, "ENDED_S", 0.0)
    with closing(open_study(tmp_path, 1)), pytest.raises(ServiceError, match="another process is learning in"):
        open_study(tmp_path, 1)
