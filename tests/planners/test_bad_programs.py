"""Planners that crash, print garbage, never end, fill the disk or eat the memory: a reason, no orphan, no file left."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from planners.programs import CRASH, ENDLESS, FILL, GARBAGE, HANG, HOG, LONG_LINE, SMALL, ends, program, started
from planning.samples import CLEANED, LAB, WIPING
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.cp_sat.solver import CpSat
from skillc_runtime.planning.fast_downward.solver import FastDownward, Programs
from skillc_runtime.planning.plan import GaveUp
from skillc_runtime.planning.problem.pose import pose_problem
from waiting import LONG_S

PROBLEM = pose_problem(WIPING, LAB, CLEANED).problem
TRANSLATED = 'touch task.sas; echo "Translator axioms: 0"'
SECONDS = 1.5
"""The time for planning with a program that never ends, unless the machine is too busy to start it within that."""


def translating(folder: Path, script: str, seconds: float = LONG_S) -> object:
    """Plan with a translator that behaves badly."""
    return FastDownward(Programs((program(folder, "translate", script),), "", ("",)), SMALL).plan(
        PROBLEM, CancelToken(seconds)
    )


def searching(folder: Path, script: str, seconds: float = LONG_S) -> object:
    """Plan with two search programs that behave badly."""
    bad = program(folder, "search", script)
    programs = Programs((program(folder, "translate", TRANSLATED),), bad, (bad,))
    return FastDownward(programs, SMALL).plan(PROBLEM, CancelToken(seconds))


def scheduling(folder: Path, script: str, seconds: float = LONG_S) -> object:
    """Look for a schedule with a program that behaves badly."""
    return CpSat((program(folder, "cp_sat", script),), SMALL).schedule(PROBLEM, None, CancelToken(seconds))


PLACES = (translating, searching, scheduling)
BROKEN = {
    CRASH: "ended by signal 11",
    GARBAGE: "",
    HANG: "ran out of time",
    LONG_LINE: "",
    ENDLESS: "",
    FILL: "",
    HOG: "MemoryError",
    "exit 0": "",
}


@pytest.mark.slow
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("script", BROKEN)
def test_a_bad_program_is_a_planner_that_gives_up_and_leaves_nothing(
    script: str, place: Callable[..., object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "work").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "work"))
    seconds = SECONDS if script == HANG else LONG_S
    answer = place(tmp_path, script, seconds)
    while script == HANG and not started(tmp_path):
        seconds *= 2
        answer = place(tmp_path, script, seconds)
    assert isinstance(answer, GaveUp), answer
    assert BROKEN[script] in answer.why
    assert len(answer.why) < 400
    assert not list((tmp_path / "work").iterdir())
    pids = started(tmp_path)
    assert bool(pids) == (script == HANG)
    assert all(ends(pid) for pid in pids)


@pytest.mark.parametrize("place", PLACES)
def test_without_a_place_to_work_in_a_planner_gives_up(
    place: Callable[..., object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "missing"))
    answer = place(tmp_path, "exit 0")
    assert isinstance(answer, GaveUp) and "cannot use its working folder" in answer.why
    assert not started(tmp_path)
