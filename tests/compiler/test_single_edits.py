"""One mistake anywhere in a library is one error at its place; `EDITS=10000` tries so many."""

import os
import random
from collections.abc import Iterator
from functools import cache

import pytest
from shipped import library, shelf, vocabulary
from single_edits import Edit, apply_edits, describe, edited_lines, independent_edits, single_edit
from test_libraries import LIBRARIES, text_of

from skillc_compiler.pipeline import compile
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

TRIED = int(os.environ.get("EDITS", "80"))


@cache
def parsed(source: Source) -> Outcome[s.File]:
    """Parse a source once."""
    return parse(source)


@cache
def libraries() -> tuple[tuple[Source, ...], ...]:
    """Return the wiping library with what it imports as one, and the libraries of other authors."""
    standard = [Source(name, source.text) for name, source in shelf().items()]
    return ((*standard, *library("wiping")), *((Source("m.skill", text_of(path.stem)),) for path in LIBRARIES))


def errors_after(seed: int, count: int) -> tuple[str, tuple[Edit, ...], list[Diagnostic], str]:
    """Return a file, its mistakes, the errors of the library with them, and the mistakes in words."""
    chance = random.Random(seed)
    sources = chance.choice(libraries())
    edited = chance.choices(sources, [len(each.text) for each in sources])[0]
    text = edited.text
    edits = (single_edit(text, seed),) if count == 1 else independent_edits(text, seed, count)
    new = Source(edited.path, apply_edits(text, edits))
    changed = [new if each is edited else each for each in sources]
    found = compile(changed, vocabulary(), shelf(), "own", parsed_by=parsed).diagnostics
    errors = [each for each in found if each.severity == "error"]
    shown = "; ".join(describe(text, edit) for edit in edits)
    return (
        text,
        edits,
        errors,
        f"{seed} {edited.path} {shown} => {[(e.span.path, e.span.line, e.name) for e in errors]}",
    )


def tried(count: int) -> Iterator[tuple[str, tuple[Edit, ...], list[Diagnostic], str]]:
    """Yield what is wrong after so many mistakes, for each seed with which there are so many errors."""
    for seed in range(TRIED):
        text, edits, errors, shown = errors_after(seed, count)
        if len(edits) == count and len(errors) >= count:
            yield text, edits, errors, shown


@pytest.mark.parametrize(("count", "most_wrong"), [(1, 0.04), (2, 0.08)])
def test_there_are_as_many_errors_as_mistakes(count: int, most_wrong: float) -> None:
    seen = list(tried(count))
    wrong = [shown for _, _, errors, shown in seen if len(errors) != count]
    assert len(seen) > TRIED / 3
    assert len(wrong) <= most_wrong * len(seen), "\n".join(wrong)


def test_an_error_or_what_it_points_to_is_at_the_mistake() -> None:
    seen = list(tried(1))
    far = [shown for text, (edit,), errors, shown in seen if not any(is_near(text, edit, error) for error in errors)]
    assert len(seen) > TRIED / 3
    assert len(far) <= 0.08 * len(seen), "\n".join(far)


def is_near(text: str, edit: Edit, error: Diagnostic) -> bool:
    """Whether an error, or a place that it points to, is within a line of a mistake."""
    lines = edited_lines(text, edit)
    places = (error.span, *(label.span for label in error.labels))
    return any(lines.start - 1 <= place.line <= lines.stop for place in places)
