"""The fuzzer's own promises: what fails, hangs or dies is found and kept, and the other cases run all the same."""

import os
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from fuzz import runner
from fuzz.runner import Plan, Result, run


class Faulty:
    """A kind whose case `at` does something bad."""

    SECONDS = 0.1

    def __init__(self, bad: Callable[[], None], at: int) -> None:
        self.bad, self.at, self.count = bad, at, 0

    def run_case(self, random: Random, folder: Path) -> None:
        (folder / "input").write_text("x")
        if folder.name.endswith(f"-{self.at}"):
            self.bad()


def fail() -> None:
    raise ValueError("a crash")


def spin() -> None:
    while True:
        try:
            sum(range(1000))
        except Exception:  # noqa: BLE001  as careless code does
            continue


def block() -> None:
    time.sleep(60)


def die() -> None:
    os._exit(7)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("bad", "said", "jobs"), [(fail, "a crash", 1), (spin, "more than", 2), (block, "no answer", 2), (die, "code 7", 2)]
)
def test_a_bad_case_is_found_and_the_others_run(
    bad: Callable[[], None], said: str, jobs: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner, "load_kind", lambda name: Faulty(bad, at=2))
    result: Result = run(Plan("faulty", 0, 0, 5, jobs, time.monotonic() + 60, tmp_path), lambda result: None)
    assert result.cases == 5
    assert [(finding.index, said in finding.problem) for finding in result.findings] == [(2, True)]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["faulty-0-2"]
