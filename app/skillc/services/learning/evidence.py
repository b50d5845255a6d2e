"""The comment above learned values: how they were found, and how they do in worlds that were not used for that."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from skillc.services.learning.result import Compared, Learned
from skillc.services.learning.text import MARK

WIDTH = 108


def write_evidence(learned: Learned, number: int, context: str) -> tuple[str, ...]:
    """Return the lines of the comment for a candidate; `context` says what was simulated."""
    parts = (*_describe_search(learned, number, context), *_describe_fresh(learned))
    lines = textwrap.wrap(" ".join(parts), WIDTH, break_long_words=False, break_on_hyphens=False)
    return tuple(f"{MARK if index == 0 else '# '}{line}" for index, line in enumerate(lines))


def _describe_search(learned: Learned, number: int, context: str) -> Iterator[str]:
    subject = f" subject to {', '.join(learned.subject_to)}," if learned.subject_to else ""
    yield f"for {learned.task} in {context}: least {', '.join(learned.minimise)},{subject}"
    yield f"candidate {number} of {len(learned.candidates)}, tried with seeds {format_seeds(learned.seeds)}."


def _describe_fresh(learned: Learned) -> Iterator[str]:
    fresh = learned.fresh
    if fresh is None:
        yield "It was not tried with other seeds."
        return
    count = len(fresh.seeds)
    yield f"With seeds {format_seeds(fresh.seeds)}, which were not used to choose it,"
    yield f"{fresh.learned_met} of {count} trials met all constraints (with the values before: {fresh.defaults_met});"
    yield f"{', '.join(map(format_compared, fresh.objectives))}."


def format_compared(each: Compared) -> str:
    """Return how an objective has changed: `simulated_time 58.6 -> 41.2 (-18.9 to -15.8)`."""
    interval = "" if each.interval is None else f" ({each.interval.low:+.3g} to {each.interval.high:+.3g})"
    return f"{each.objective} {each.defaults:.3g} -> {each.learned:.3g}{interval}"


def format_seeds(seeds: tuple[int, ...]) -> str:
    """Return successive seeds as text: `5 to 14`."""
    return str(seeds[0]) if len(seeds) == 1 else f"{seeds[0]} to {seeds[-1]}"
