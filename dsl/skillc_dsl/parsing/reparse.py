"""Parses a file again after an edit: only the declarations that were edited, with the same result as from nothing."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import partial
from itertools import pairwise
from typing import TypeAlias

from msgspec import structs

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.encoding import MOST_CHARACTERS
from skillc_dsl.parsing.parser import MOST_PROBLEMS, parse, parse_once
from skillc_dsl.query import Memo
from skillc_dsl.source import Source

_KEYWORDS = r"class|relation|property|function|skill|impl|task|test(?=\s+\w+\s*\{)"
_DECLARATION = re.compile(
    rf"^(?:(?:[ \t]*#[^\n]*\n)++(?:(?P<below>{_KEYWORDS})\b)?|(?P<first>{_KEYWORDS})\b)", re.MULTILINE
)
"""A declaration with the comments above it, or comments above something else, which are not read again line by line."""
_CLEAN = "parse without errors"
Parsed: TypeAlias = tuple[Source, Outcome[s.File]]


def parse_with(memo: Memo, source: Source) -> Outcome[s.File]:
    """Return what `parse` returns, given what the memo knows of the last texts of the file."""
    known: Iterable[Parsed] = memo.recent("parse", source.path)
    parsed = next((each for each in known if each[0] == source), None)
    if parsed is None:
        inputs = source.path, source.text, str(source.unreadable), str(source.edition)
        parsed = source, memo.recall("parse", inputs, partial(_parse, memo, source))
    if not parsed[1].diagnostics and not parsed[1].value.errors:
        memo.same(_CLEAN, source.path, parsed)
    return memo.same("parse", source.path, parsed)[1]


def _parse(memo: Memo, source: Source) -> Outcome[s.File]:
    clean: Parsed | None = next(iter(memo.recent(_CLEAN, source.path)), None)
    return (reparse(clean[0], clean[1].value, source) if clean else None) or parse_once(source)


def reparse(before: Source, file: s.File, source: Source) -> Outcome[s.File] | None:
    """Return what `parse` returns for `source`, given the tree of the text before, which has no errors.

    The edited declarations are parsed with the one below them, which shows where their errors end. None if lines have
    moved, or if the errors go on below.
    """
    old, new = _chunks(before.text), _chunks(source.text)
    above = _common(old, new)
    below = _common(old[above:][::-1], new[above:][::-1])
    window, rest = new[above : len(new) - below], new[len(new) - below :]
    first = 1 + sum(chunk.count("\n") for chunk in new[:above])
    end = first + sum(chunk.count("\n") for chunk in window)
    moved = end != first + sum(chunk.count("\n") for chunk in old[above : len(old) - below])
    if (
        moved
        or before.edition != source.edition
        or len(source.text) > MOST_CHARACTERS
        or source.unreadable
        or "\0" in source.text
    ):
        return None
    found = parse(source._replace(text="\n" * (first - 1) + "".join((*window, *rest[:1]))))
    following = [each for each in file.declarations if rest and each.span.line >= end]
    if not _ends_before(found, following, end if rest else None) or (above and found.value.header):
        return None
    edited = (each for each in found.value.declarations if not rest or each.span.line < end)
    kept = (each for each in file.declarations if each.span.line < first)
    header = file.header if above else found.value.header
    file = structs.replace(found.value, header=header, declarations=(*kept, *edited, *following))
    return Outcome(file, found.diagnostics)


def _ends_before(found: Outcome[s.File], following: Sequence[s.Declaration], end: int | None) -> bool:
    """Whether no error goes on at the line `end`, where the first of the following declarations begins."""
    if len(found.diagnostics) >= MOST_PROBLEMS:
        return False
    if end is None:
        return True
    places = (*(each.span for each in found.diagnostics), *(each.span for each in found.value.errors))
    below = [each for each in found.value.declarations if each.span.line >= end]
    return all(place.end_line < end for place in places) and below == following[: len(below)] and bool(below)


def _chunks(text: str) -> list[str]:
    """Return the text in parts: what is above the declarations, and each declaration with the comments above it."""
    found = (match.start() for match in _DECLARATION.finditer(text) if match.lastgroup)
    starts = [0, *found, len(text)]
    return [text[start:end] for start, end in pairwise(starts)]


def _common(one: Sequence[str], other: Sequence[str]) -> int:
    """Return how many parts both begin with."""
    pairs = zip(one, other, strict=False)
    return next((number for number, (left, right) in enumerate(pairs) if left != right), min(len(one), len(other)))
