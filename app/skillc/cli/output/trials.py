"""A series of trials as text for the terminal: how many passed, the distribution of each metric, what failed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from statistics import fmean

from skillc.cli.layout import Row, TableCell, TerminalPage
from skillc_runtime.evaluation.trials.confidence import LEVEL, Interval
from skillc_runtime.evaluation.trials.series import FailedSeed, Series, Spread
from skillc_runtime.evaluation.trials.summary import format_false_successes, format_unverified

BINS = 8
BLOCKS, ASCII_BLOCKS = "▁▂▃▄▅▆▇█", ".:-=+*#@"
"""The characters of a histogram, for few to many values; a bin without values is a blank."""

HEADER = ("metric", "min", "25 %", "median", "75 %", "max", f"mean, {LEVEL:.0%} CI", "histogram", "target", "met")
NUMBERS = (1, 2, 3, 4, 5)
"""The columns that are aligned to the right."""

NARROW = (0, 1, 3, 5, 6, 7, 9)
"""The columns that are shown if there is no room for all."""


def format_series(series: Series, page: TerminalPage, is_unicode: bool) -> str:
    """Return how many trials passed, the spread of each metric, each failed seed with its reasons, and the time."""
    sections = [
        list(_list_headline(series, page)),
        _list_spreads(series.spreads, page, is_unicode),
        [line for failed in series.failed for line in _list_failed(failed, page)],
        page.wrap(_describe_time(series), "dim", hanging="  "),
    ]
    return "\n\n".join("\n".join(lines) for lines in sections if lines)


def draw_histogram(values: Sequence[float], low: float, high: float, is_unicode: bool = True) -> str:
    """Return how many of the values are in each of BINS bins between `low` and `high`, a character for each bin."""
    counts = [0] * BINS
    for value in values:
        share = (value - low) / (high - low) if high > low else 0.5
        counts[min(int(share * BINS), BINS - 1)] += 1
    blocks, most = BLOCKS if is_unicode else ASCII_BLOCKS, max(counts)
    return "".join(blocks[(count * len(blocks) - 1) // most] if count else " " for count in counts)


def _list_headline(series: Series, page: TerminalPage) -> Iterator[str]:
    disturbed = "" if series.disturbance == "none" else f"  disturbed: {series.disturbance}"
    done = "" if series.done == series.wanted else f", {series.wanted - series.done} not done"
    passed = f"{series.passed} of {series.wanted} trials passed{done}"
    yield f"{page.paint(series.task, 'strong')}{disturbed}  {page.paint(passed, 'good' if series.is_good else 'bad')}"
    if series.pass_interval is not None:
        low, high = 100 * series.pass_interval.low, 100 * series.pass_interval.high
        share = f"{100 * series.passed / series.done:.3g} % passed"
        interval = f"{LEVEL:.0%} confidence interval {low:.3g} to {high:.3g} % (Wilson)"
        yield from page.wrap(f"{share}, {interval}", hanging="  ")
    yield from page.wrap(format_false_successes(series), "bad", hanging="  ") if series.false_successes else ()
    yield from page.wrap(format_unverified(series), "warning", hanging="  ") if series.unverified else ()


def _list_spreads(spreads: Sequence[Spread], page: TerminalPage, is_unicode: bool) -> list[str]:
    several = len({spread.subject for spread in spreads if spread.subject}) > 1
    rows = [_spread_row(spread, several, is_unicode) for spread in spreads]
    missed = [f"{spread.metric}: {spread.median_missed}" for spread in spreads if spread.median_missed]
    table = _tabulate(rows, page) or [line for row in rows for line in _spread_paragraph(row, page)]
    return [*table, *(line for text in missed for line in page.wrap(text, "bad", hanging="  "))]


def _tabulate(rows: Sequence[Row], page: TerminalPage) -> list[str]:
    """Return the table with all columns, or with those that fit; empty if there is no room for it."""
    for columns in (range(len(HEADER)), NARROW):
        header, shown = [HEADER[column] for column in columns], [[row[column] for column in columns] for row in rows]
        if rows and page.has_room(header, shown):
            numbers = [index for index, column in enumerate(columns) if column in NUMBERS]
            return page.table(header, shown, right=numbers)
    return []


def _spread_paragraph(row: Row, page: TerminalPage) -> Iterator[str]:
    """Yield a row below the name of its metric, without the histogram."""
    metric, least, low, middle, high, greatest, mean, _, target, met = (
        cell.text if isinstance(cell, TableCell) else cell for cell in row
    )
    yield from page.wrap(f"{metric}: {target}, {met}" if target else metric, hanging="  ")
    yield from page.wrap(f"{least} to {greatest}, quartiles {low}, {middle}, {high}; mean {mean}", "dim", "    ")


def _spread_row(spread: Spread, named: bool, is_unicode: bool) -> Row:
    name = f"{spread.subject} {spread.metric}" if named and spread.subject else spread.metric
    numbers = (spread.least, spread.low_quartile, spread.median, spread.high_quartile, spread.greatest)
    is_met, bound = spread.met == len(spread.values), spread.bound is not None
    return (
        f"{name}, {spread.unit}",
        *(f"{number:.3g}" for number in numbers),
        _format_mean(spread.mean, spread.mean_interval),
        draw_histogram(spread.values, spread.least, spread.greatest, is_unicode),
        spread.target.removesuffix(f" {spread.unit}") if bound else "",
        TableCell(f"{spread.met} of {len(spread.values)}", "" if is_met else "bad") if bound else "",
    )


def _format_mean(mean: float, interval: Interval | None) -> str:
    return f"{mean:.3g}" if interval is None else f"{mean:.3g} +- {(interval.high - interval.low) / 2:.2g}"


def _list_failed(failed: FailedSeed, page: TerminalPage) -> Iterator[str]:
    yield from page.wrap(f"seed {failed.seed}: {'; '.join(failed.reasons)}", "bad", hanging="  ")
    yield from page.wrap(failed.variation, "dim", "  ") if failed.variation else ()


def _describe_time(series: Series) -> str:
    if not series.done or not series.mean_wall_time_s:
        return ""
    simulated, computed = fmean(trial.sim_time_s for trial in series.trials), series.mean_wall_time_s
    each = f"{simulated:.1f} s simulated and {computed:.1f} s computed for each trial"
    return f"{each}, {simulated / computed:.1f} x real time"
