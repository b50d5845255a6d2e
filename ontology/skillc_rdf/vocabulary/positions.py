"""Finds the positions of subjects in Turtle files with a light scanner: RDF parsers keep no positions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from types import MappingProxyType
from typing import NamedTuple

from skillc_dsl.position import Position
from skillc_dsl.source import Source

MOST_FILES = 64
"""The number of files whose positions are cached: more than are shipped."""

TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"
_TOKEN = re.compile(
    r"""
    (?P<skipped> \#[^\n]* | \"{3}(?:[^"\\]|\\.|\"(?!\"\"))*\"{3} | '{3}(?:[^'\\]|\\.|'(?!''))*'{3}
               | \"{3}.* | '{3}.* | "(?:[^"\\\n]|\\.)*" | '(?:[^'\\\n]|\\.)*' | ["'][^\n]* )
  | <(?P<iri> [^<>"\s]* )>
  | (?P<name> (?:[\w-](?:[\w.-]*[\w-])?)? : (?: (?:[\w:%-]|\\.)(?: (?:[\w:.%-]|\\.)* (?:[\w:%-]|\\.) )? )? )
  | (?P<mark> [.;,\[\]()] (?!\d) )
  | (?P<word> [^\s<>"'\[\](),;\#]* [^\s<>"'\[\](),;\#.] )
    """,
    re.VERBOSE | re.DOTALL,
)


class _Subject(NamedTuple):
    """A subject: its IRI, its offset, and whether the statement begins with its class."""

    iri: str
    offset: int
    declared: bool


class _Found(NamedTuple):
    """The position of a subject, and whether it is declared there."""

    declared: bool
    position: Position


def find_subjects(sources: Iterable[Source]) -> dict[str, Position]:
    """Return for each subject where it is declared (`a ..` comes first), else where it is a subject first."""
    found: dict[str, _Found] = {}
    for source in sources:
        for iri, here in _in_file(source).items():
            if iri not in found or (here.declared and not found[iri].declared):
                found[iri] = here
    return {iri: each.position for iri, each in found.items()}


@lru_cache(maxsize=MOST_FILES)
def _in_file(source: Source) -> Mapping[str, _Found]:
    """Return the same for one file; cached, since shipped files are read often while a vocabulary is edited."""
    found: dict[str, _Found] = {}
    line, seen = 1, 0
    for subject in _subjects(source.text):
        line += source.text.count("\n", seen, subject.offset)
        seen = subject.offset
        if subject.iri not in found or (subject.declared and not found[subject.iri].declared):
            column = seen - source.text.rfind("\n", 0, seen)
            found[subject.iri] = _Found(subject.declared, Position(source.path, line, column))
    return MappingProxyType(found)


def _subjects(text: str) -> Iterator[_Subject]:
    """Yield the named subjects of statements."""
    prefixes: dict[str, str] = {}
    statement: list[re.Match[str]] = []
    depth = 0
    for token in _TOKEN.finditer(text):
        if token["skipped"]:
            continue
        mark = token["mark"]
        depth += {"[": 1, "(": 1, "]": -1, ")": -1}.get(mark or "", 0)
        if not statement and depth == 0 and mark:
            continue
        if len(statement) < 3:
            statement.append(token)
        if len(statement) == 3 and _is_prefix(statement):
            prefixes[statement[1]["name"].rstrip(":")] = statement[2]["iri"]
            statement = []
        elif len(statement) == 2 and depth == 0:
            yield from _subject(statement[0], statement[1], prefixes)
        if mark == "." and depth == 0:
            statement = []


def _is_prefix(statement: list[re.Match[str]]) -> bool:
    word, name, iri = statement
    return (word["word"] or "").lower() in ("@prefix", "prefix") and bool(name["name"]) and iri["iri"] is not None


def _subject(first: re.Match[str], second: re.Match[str], prefixes: dict[str, str]) -> Iterator[_Subject]:
    iri = _expanded(first, prefixes)
    if iri is not None:
        declared = second["word"] == "a" or _expanded(second, prefixes) == TYPE
        yield _Subject(iri, first.start(), declared)


def _expanded(token: re.Match[str], prefixes: dict[str, str]) -> str | None:
    if token["iri"] is not None:
        return str(token["iri"])
    prefix, colon, local = (token["name"] or "").partition(":")
    return prefixes[prefix] + re.sub(r"\\(.)", r"\1", local) if colon and prefix in prefixes else None
