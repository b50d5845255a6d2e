"""A series of trials as a table for the terminal."""

from __future__ import annotations

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from skillc_runtime.evaluation.trials.series import Series, Spread
from skillc_runtime.recording.known_facts import UNVERIFIED


def render_table(series: Series) -> RenderableType:
    """Return the spread of each metric, each failed seed with its reasons, and the number of trials that passed."""
    return Group(
        _render_headline(series),
        *_render_false_successes(series),
        *_render_unverified(series),
        *_render_spreads(series.spreads),
        *_render_failed(series),
        "",
    )


def _render_headline(series: Series) -> Text:
    style = "bold green" if series.is_good else "bold red"
    disturbed = "" if series.disturbance == "none" else f"  disturbed: {series.disturbance}"
    done = "" if series.done == series.wanted else f", {series.wanted - series.done} not done"
    passed = f"{series.passed} of {series.wanted} trials passed{done}"
    return Text.assemble((series.task, "bold"), disturbed, "  ", (passed, style))


def _render_false_successes(series: Series) -> list[RenderableType]:
    words = format_false_successes(series)
    return [Text(words, style="bold red")] if words else []


def format_false_successes(series: Series) -> str:
    """Return how many trials succeeded with a false claim; empty if none did."""
    if not series.false_successes:
        return ""
    return f"{series.false_successes} of {series.done} succeeded with a false claim"


def _render_unverified(series: Series) -> list[RenderableType]:
    words = format_unverified(series)
    return [Text(words, style="yellow")] if words else []


def format_unverified(series: Series) -> str:
    """Return how many trials finished without being verified, and why; empty if all were verified."""
    if not series.unverified:
        return ""
    return f"{series.unverified} of {series.done} {UNVERIFIED}: only assumed: {'; '.join(series.assumed)}"


def _render_spreads(spreads: tuple[Spread, ...]) -> list[RenderableType]:
    several = len({spread.subject for spread in spreads}) > 1
    if not spreads:
        return []
    table = Table(box=None, pad_edge=False)
    table.add_column("metric", style="dim")
    for name in ("min", "median", "max"):
        table.add_column(name, justify="right")
    table.add_column("target")
    table.add_column("met", justify="right")
    for spread in spreads:
        name = f"{spread.subject} {spread.metric}" if several else spread.metric
        numbers = (f"{value:.3g}" for value in (spread.least, spread.median, spread.greatest))
        met, count = f"{spread.met} of {len(spread.values)}", len(spread.values)
        table.add_row(name, *numbers, spread.target, Text(met, style="" if spread.met == count else "red"))
    missed = [f"{spread.metric}: {spread.median_missed}" for spread in spreads if spread.median_missed]
    return [table, *(Text(line, style="red") for line in missed)]


def _render_failed(series: Series) -> list[RenderableType]:
    return [
        Text(f"seed {failed.seed}: {'; '.join(failed.reasons)}\n  {failed.variation}".rstrip(), style="red")
        for failed in series.failed
    ]
