"""What bisection finds among spans is what trying each of them finds."""

from __future__ import annotations

from random import Random

from skillc_compiler.program.spans import DisjointSpans, SpanIndex
from skillc_dsl.source import Span


def test_random_places_are_found_as_by_trying_each() -> None:
    random = Random(7)
    found = set()
    for _ in range(300):
        places = [_span(random) for _ in range(random.randrange(6))]
        declarations = [each for path in "ab" for each in _one_after_another(random, path)]
        whole = _span(random)
        within, lines = any(_inside(each, whole) for each in places), any(_begins_on(each, whole) for each in places)
        around = next((each for each in declarations if _inside(whole, each)), None)
        assert SpanIndex(places).any_inside(whole) == within, (places, whole)
        assert SpanIndex(places).any_on_lines_of(whole) == lines, (places, whole)
        assert DisjointSpans(reversed(declarations)).enclosing(whole) == around, (declarations, whole)
        found.add((within, lines, around is not None))
    assert {each for each, _, _ in found} == {each for _, each, _ in found} == {each for _, _, each in found}
    assert len(found) > 4


def _span(random: Random) -> Span:
    start, end = sorted((random.randrange(1, 9), random.randrange(1, 5)) for _ in range(2))
    return Span(random.choice("ab"), *start, *end)


def _one_after_another(random: Random, path: str) -> list[Span]:
    points = sorted({(random.randrange(1, 9), random.randrange(1, 5)) for _ in range(8)})
    return [Span(path, *start, *end) for start, end in zip(points[::2], points[1::2], strict=False)]


def _inside(place: Span, whole: Span) -> bool:
    starts, ends = (place.line, place.column), (place.end_line, place.end_column)
    bounds = (whole.line, whole.column), (whole.end_line, whole.end_column)
    return place.path == whole.path and bounds[0] <= starts and ends <= bounds[1]


def _begins_on(place: Span, whole: Span) -> bool:
    return place.path == whole.path and whole.line <= place.line <= whole.end_line
