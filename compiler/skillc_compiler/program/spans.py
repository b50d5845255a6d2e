"""Search in many spans by bisection: which one encloses a place, and whether one is within a span."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Iterable
from itertools import accumulate
from typing import TypeAlias

from skillc_dsl.source import Span

Point: TypeAlias = tuple[int, int]


class DisjointSpans:
    """Spans that do not overlap, such as those of declarations."""

    def __init__(self, spans: Iterable[Span]) -> None:
        self._spans = _by_path(spans)
        self._starts = {path: [_start(each) for each in spans] for path, spans in self._spans.items()}
        self._end_lines = {path: [each.end_line for each in spans] for path, spans in self._spans.items()}

    def first_on_line_of(self, place: Span) -> Span | None:
        """Return the first span that has the line on which the place begins, or None."""
        index = bisect_left(self._end_lines.get(place.path, ()), place.line)
        candidates = self._spans.get(place.path, [])[index : index + 1]
        return next((each for each in candidates if each.line <= place.line), None)

    def enclosing(self, place: Span) -> Span | None:
        """Return the span that encloses the place, or None."""
        index = bisect_right(self._starts.get(place.path, ()), _start(place)) - 1
        if index < 0:
            return None
        candidate = self._spans[place.path][index]
        return candidate if _end(place) <= _end(candidate) else None


class SpanIndex:
    """Spans that may overlap."""

    def __init__(self, spans: Iterable[Span]) -> None:
        by_path = _by_path(spans)
        self._starts = {path: [_start(each) for each in spans] for path, spans in by_path.items()}
        self._least_ends = {path: _least_ends(spans) for path, spans in by_path.items()}
        self._lines = {path: [each.line for each in spans] for path, spans in by_path.items()}

    def any_inside(self, whole: Span) -> bool:
        """Whether any of the spans is within `whole`."""
        index = bisect_left(self._starts.get(whole.path, ()), _start(whole))
        ends = self._least_ends.get(whole.path, [])
        return index < len(ends) and ends[index] <= _end(whole)

    def any_on_lines_of(self, whole: Span) -> bool:
        """Whether any of the spans begins on a line of `whole`."""
        lines = self._lines.get(whole.path, [])
        index = bisect_left(lines, whole.line)
        return index < len(lines) and lines[index] <= whole.end_line


def _by_path(spans: Iterable[Span]) -> dict[str, list[Span]]:
    found: dict[str, list[Span]] = defaultdict(list)
    for span in sorted(spans):
        found[span.path].append(span)
    return dict(found)


def _least_ends(spans: list[Span]) -> list[Point]:
    """Return for each of the sorted spans the first end among it and those after it."""
    return list(accumulate(map(_end, reversed(spans)), min))[::-1]


def _start(span: Span) -> Point:
    return span.line, span.column


def _end(span: Span) -> Point:
    return span.end_line, span.end_column
