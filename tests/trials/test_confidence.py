"""Confidence intervals against published values, and what a series says about its distribution."""

from __future__ import annotations

import pytest

from skillc.cli.layout import TerminalPage
from skillc.cli.output.trials import draw_histogram, format_series
from skillc_runtime.evaluation.trials.confidence import (
    compute_mean_interval,
    compute_proportion_interval,
    find_t_quantile,
)
from skillc_runtime.evaluation.trials.judging import judge_series
from trials.runners import GOOD, good, wiping


@pytest.mark.parametrize(
    ("freedom", "t"), [(1, 12.706), (2, 4.303), (3, 3.182), (10, 2.228), (29, 2.045), (30, 2.042), (120, 1.980)]
)
def test_quantiles_are_those_of_the_tables_of_students_distribution(freedom: int, t: float) -> None:
    assert find_t_quantile(freedom) == pytest.approx(t, abs=5e-4)


@pytest.mark.parametrize(
    ("successes", "count", "low", "high"), [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611)]
)
def test_proportions_have_the_intervals_of_newcombe_1998(successes: int, count: int, low: float, high: float) -> None:
    found = compute_proportion_interval(successes, count)
    assert (found.low, found.high) == pytest.approx((low, high), abs=1e-4)
    other = compute_proportion_interval(count - successes, count)
    assert (1.0 - other.high, 1.0 - other.low) == pytest.approx((found.low, found.high))


def test_a_mean_of_one_value_has_no_interval() -> None:
    assert compute_mean_interval([3.0]) is None
    found = compute_mean_interval([1.0, 2.0, 3.0, 4.0])
    assert found is not None and (found.low, found.high) == pytest.approx((0.4457, 4.5543), abs=1e-4)


@pytest.mark.parametrize(
    ("values", "drawn"),
    [((0.0, 0.0, 0.0, 0.0, 1.0), "█      ▂"), ((5.0, 5.0), "    █   "), (tuple(range(8)), "█" * 8)],
)
def test_a_histogram_has_a_bin_for_each_eighth_of_the_range(values: tuple[float, ...], drawn: str) -> None:
    assert draw_histogram(values, min(values), max(values)) == drawn
    plain = draw_histogram(values, min(values), max(values), is_unicode=False)
    assert plain.isascii() and [each == " " for each in plain] == [each == " " for each in drawn]


@pytest.mark.parametrize("width", [60, 80, 160])
@pytest.mark.parametrize("kind", [*GOOD, ""])
def test_every_task_has_its_distributions_and_its_time_at_every_width(kind: str, width: int) -> None:
    works = [GOOD[kind]] if kind else []
    trials = [good(seed, *works) for seed in range(4)] + [good(4, wiping(tilt_rms_deg=0.8))]
    series = judge_series("task", "none", 5, trials, [3.0, 5.0])
    lines = format_series(series, TerminalPage(width), is_unicode=True).split("\n")
    assert lines[0] == "task  4 of 5 trials passed"
    assert lines[1].startswith("80 % passed, 95% confidence interval 37.6 to 96.4 %")
    assert any(line.startswith("simulated time, s") for line in lines)
    assert "40.0 s simulated and 4.0 s computed for each trial" in "\n".join(lines)
    assert [line for line in lines if len(line) > width or line != line.rstrip()] == []
