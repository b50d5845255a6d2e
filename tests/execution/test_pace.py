"""How fast the time of a cell passes: never faster than its pace, without a rush after a delay."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc.cli.progress.run_keys import format_help
from skillc.cli.progress.run_view import RunView
from skillc_runtime.execution.pace import FAST, MAX_LAG_S, PACES, REAL, Pace, format_pace, parse_pace

TICK_S = 0.01


@dataclass
class Wall:
    """A wall clock that a test moves."""

    now: float = 100.0

    def __call__(self) -> float:
        return self.now


def run(pace: Pace, wall: Wall, computing: list[float], standing: bool = False) -> float:
    """Let a tick take each of these times to compute, wait as long as the pace says; return the cell's time after."""
    now = 0.0
    for spent in computing:
        wall.now += pace.remaining_s(now, standing)
        assert pace.remaining_s(now, standing) == pytest.approx(0.0, abs=1e-9)
        wall.now += spent
        now += TICK_S
    wall.now += pace.remaining_s(now, standing)
    return now


@given(st.sampled_from(PACES[:-1]), st.lists(st.floats(0.0, 1.0), min_size=1, max_size=200))
def test_a_cell_is_never_ahead_of_its_pace_by_more_than_it_may_catch_up(factor: float, computing: list[float]) -> None:
    wall = Wall()
    began = wall.now
    passed = run(Pace(factor, wall), wall, computing)
    assert passed / factor <= wall.now - began + MAX_LAG_S + 1e-6


@given(st.sampled_from(PACES[:-1]), st.integers(20, 300))
def test_a_cell_that_keeps_up_has_its_pace(factor: float, ticks: int) -> None:
    wall = Wall()
    began = wall.now
    passed = run(Pace(factor, wall), wall, [0.0] * ticks)
    assert wall.now - began == pytest.approx(passed / factor, abs=MAX_LAG_S + 1e-6)


def test_after_a_long_delay_a_cell_does_not_rush() -> None:
    wall = Wall()
    pace = Pace(REAL, wall)
    run(pace, wall, [0.0] * 50)
    wall.now += 60.0
    began = wall.now
    for tick in range(50, 150):
        wall.now += pace.remaining_s(tick * TICK_S)
    assert wall.now - began == pytest.approx(1.0, abs=MAX_LAG_S + 2 * TICK_S)


def test_a_fast_cell_waits_only_while_it_stands() -> None:
    wall = Wall()
    began = wall.now
    run(Pace(FAST, wall), wall, [0.0] * 100)
    assert wall.now == began
    run(Pace(FAST, wall), wall, [0.0] * 100, standing=True)
    assert wall.now - began == pytest.approx(1.0, abs=MAX_LAG_S + 2 * TICK_S)


def test_a_changed_pace_takes_effect_at_once() -> None:
    wall = Wall()
    pace = Pace(0.001, wall)
    run(pace, wall, [0.0])
    pace.remaining_s(1.0)
    assert pace.remaining_s(1.0) > 100.0
    pace.faster()
    assert (pace.factor, pace.remaining_s(1.0)) == (PACES[0], 0.0)


def test_paces_change_one_by_one_and_end_at_both_ends() -> None:
    pace, seen = Pace(PACES[0]), []
    for _ in range(len(PACES) + 1):
        seen.append(pace.factor)
        pace.faster()
    assert seen == [*PACES, FAST]
    for _ in range(len(PACES) + 1):
        pace.slower()
    assert pace.factor == PACES[0]


def test_that_of_devices_is_fixed_and_no_keys_are_offered_for_it() -> None:
    pace, run = Pace(), RunView("running", "", ("pause",))
    assert format_help(run, pace, detachable=False) == "p pause  + - pace: fast"
    pace.fix()
    assert format_help(run, pace, detachable=False) == "p pause"
    assert pace.factor == REAL


@pytest.mark.parametrize(("text", "factor"), [("fast", FAST), ("real", REAL), ("1", REAL), ("0.5", 0.5), ("20", 20.0)])
def test_a_pace_is_read(text: str, factor: float) -> None:
    assert parse_pace(text) == factor
    assert parse_pace(format_pace(factor)) == factor


@pytest.mark.parametrize("text", ["", "slow", "0", "-1", "inf", "nan", "1x", "1e999"])
def test_what_is_no_pace_is_refused_with_what_to_write(text: str) -> None:
    with pytest.raises(ValueError, match=r"write `fast`, `real`, or a factor"):
        parse_pace(text)
