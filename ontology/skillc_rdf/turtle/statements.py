"""The result of parsing a Turtle text: statements with the extents of their terms."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

import msgspec
import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.turtle.lines import Lines

Node: TypeAlias = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple
"""A term. `ox.Triple` is for the type checker only: Turtle 1.1 has no statements about statements."""


SOMETHING = ""
"""Stands for the unknown subject of a statement without a beginning."""


class Extent(NamedTuple):
    """The offsets where a range of text begins and ends."""

    start: int
    end: int


class Statement(NamedTuple):
    """A statement and the extents of its terms; for `[ ]` and `( )` that of the opening bracket."""

    subject: Node
    predicate: str
    object: Node
    subject_at: Extent
    predicate_at: Extent
    object_at: Extent
    lines: Lines

    @property
    def subject_place(self) -> Span:
        """The span of the subject, which several statements may share."""
        return self.lines.place(*self.subject_at)

    @property
    def predicate_place(self) -> Span:
        """The span of the predicate."""
        return self.lines.place(*self.predicate_at)

    @property
    def object_place(self) -> Span:
        """The span of the object."""
        return self.lines.place(*self.object_at)


class Parsed(msgspec.Struct, frozen=True):
    """The statements of a text in order, its prefixes, and diagnostics.

    `doubtful` are the IRIs about which the text may state more than could be parsed; SOMETHING if one is unknown.
    """

    statements: tuple[Statement, ...]
    prefixes: dict[str, str]
    problems: tuple[Diagnostic, ...]
    doubtful: frozenset[str]
