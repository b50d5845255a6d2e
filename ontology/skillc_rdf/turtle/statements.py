"""What a Turtle text says: statements with the places of their terms."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.turtle.lines import Lines

Node: TypeAlias = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple
"""A term; `ox.Triple` only for the type checker, Turtle 1.1 has no statements about statements."""


SOMETHING = ""
"""Stands for what a statement is about that has lost its beginning."""


class Extent(NamedTuple):
    """A stretch of text by the offsets where it begins and ends."""

    start: int
    end: int


class Statement(NamedTuple):
    """A statement and where its terms stand; of `[ ]` and `( )` the place is that of the opening bracket."""

    subject: Node
    predicate: str
    object: Node
    subject_at: Extent
    predicate_at: Extent
    object_at: Extent
    lines: Lines

    @property
    def subject_place(self) -> Span:
        """Where its subject stands, once for all that is said of it."""
        return self.lines.place(*self.subject_at)

    @property
    def predicate_place(self) -> Span:
        """Where its predicate stands."""
        return self.lines.place(*self.predicate_at)

    @property
    def object_place(self) -> Span:
        """Where its object stands."""
        return self.lines.place(*self.object_at)


@dataclass(frozen=True, slots=True)
class Parsed:
    """The statements of a text in order, its prefixes, and what is wrong with it.

    `doubtful` are the IRIs of which more may be said than was understood, with SOMETHING where one is not known.
    """

    statements: tuple[Statement, ...]
    prefixes: dict[str, str]
    problems: tuple[Diagnostic, ...]
    doubtful: frozenset[str]
