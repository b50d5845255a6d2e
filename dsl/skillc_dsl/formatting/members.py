"""Members of skills, implementations and tasks: the cells of their lines."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token, Tree

from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.columns import KEYWORD, Cell, Member, aligned
from skillc_dsl.formatting.inline import Branch, index_of, is_token
from skillc_dsl.formatting.steps import Steps, has_braces

_LOOSE = ("duration", "shares")
"""Keywords that are longer than most: they widen no column."""


class Members(Steps):
    """Makes documents of members, aligned in each block."""

    def members(self, children: Sequence[Branch], least: int) -> d.Document:
        """Return a block of members from its `{` to its `}`; the keywords' column is `least` wide at least."""
        opening, *inner, closing = children
        if not isinstance(opening, Token) or not isinstance(closing, Token):
            raise TypeError(f"braces were expected, not {children!r}")
        if not inner and self.notes.behind(opening) == self.notes.above(closing) == d.NOTHING:
            return d.joined(d.Mark(" {"), d.Space(), self.bare(closing))
        rows = aligned([self._member(child) for child in inner if isinstance(child, Tree)], least)
        body = (part for row in rows for part in (d.NewLine(), row))
        lines = d.Nest(d.joined(*body, self.above_closing(closing)))
        return d.joined(self.opening(opening), lines, d.NewLine(), self.bare(closing))

    def _member(self, tree: Tree[Token]) -> Member:
        keyword, *rest = tree.children
        if not isinstance(keyword, Token):
            raise TypeError(f"a keyword was expected, not {keyword!r}")
        above = self.notes.above(keyword)
        if tree.data == "body" and has_braces(rest[0]):
            return Member(above, (), d.joined(self.bare(keyword), d.Space(), self.step(rest[0])))
        if not rest:
            return Member(above, (), self.bare(keyword))
        if tree.data in ("parameter", "refinement"):
            return self._parameter(keyword, rest, above)
        first = Cell(KEYWORD, self.bare(keyword), loose=keyword.value in _LOOSE)
        if tree.data == "let":
            return Member(above, (first, Cell("let", self.of(rest[0]))), self.spaced(rest[1:]))
        if is_token(rest[0], "LABEL"):
            return Member(above, (first, Cell("name", self.of(rest[0]))), self.spaced(rest[1:]))
        if len(rest) > 1 and is_token(rest[1], "LABEL"):
            return Member(above, (first, Cell("sensed", self.spaced(rest[:2]))), self.spaced(rest[2:]))
        return Member(above, (first,), self.spaced(rest))

    def _parameter(self, keyword: Token, rest: Sequence[Branch], above: d.Document) -> Member:
        """Return `in name: Type = default  range a .. b`; a type or default is a cell where something follows it."""
        at = index_of(rest, "LABEL")
        cells = [Cell(KEYWORD, self.bare(keyword)), Cell("name", self.spaced(rest[: at + 1]))]
        type_, *extras = rest[at + 1 :]
        if not extras:
            return Member(above, tuple(cells), self.of(type_))
        has_default = isinstance(extras[0], Tree) and extras[0].data == "default"
        cells.append(Cell("type", self.of(type_), gap=1 if has_default else 2))
        if len(extras) > 1:
            cells.append(Cell("default", self.of(extras[0]), gap=2))
        return Member(above, tuple(cells), self.of(extras[-1]))
