"""Edits of a text: several fixes are applied at once if they do not overlap."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import accumulate

from skillc_dsl.diagnostics import Fix
from skillc_dsl.source import Span


def apply_fixes(text: str, fixes: Iterable[Fix]) -> str:
    """Return `text` after fixes that are `drop_overlapping` keeps. ValueError for a place that is not in the text."""
    starts = [0, *accumulate(len(line) + 1 for line in text.split("\n"))]
    ordered = sorted(((*_offsets(starts, fix.span), fix.text) for fix in fixes), reverse=True)
    for start, end, replacement in ordered:
        text = text[:start] + replacement + text[end:]
    return text


def drop_overlapping(fixes: Iterable[Fix]) -> tuple[Fix, ...]:
    """Return fixes of one file in order of place, without duplicates and those that touch an earlier one."""
    kept: list[Fix] = []
    for fix in sorted(set(fixes), key=lambda each: (each.span, each.text)):
        if not kept or _end(kept[-1].span) < (fix.span.line, fix.span.column):
            kept.append(fix)
    return tuple(kept)


def _end(span: Span) -> tuple[int, int]:
    return span.end_line, span.end_column


def _offsets(starts: Sequence[int], span: Span) -> tuple[int, int]:
    """Return the offsets of a span, given those of the lines' starts, the last of which is where the text ends."""
    if not 1 <= span.line <= span.end_line < len(starts):
        raise ValueError(f"there is no {span}")
    return starts[span.line - 1] + span.column - 1, starts[span.end_line - 1] + span.end_column - 1
