"""Documents for the members of skills, implementations and tasks, in aligned columns."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_dsl.descriptions.members import MEMBERS
from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.columns import KEYWORD, ColumnCell, MemberLine, align_columns
from skillc_dsl.formatting.inline import index_of, is_token
from skillc_dsl.formatting.steps import StepFormatter, has_braces
from skillc_dsl.parsing.tokens import Branch, Token, Tree

_LOOSE = frozenset(each.words[0].text for each in MEMBERS if each.long)
"""Long keywords, which do not widen their column, as what follows them is in no other column."""


class MemberFormatter(StepFormatter):
    """Creates the documents of members, aligned in each block."""

    def members(self, children: Sequence[Branch], least: int) -> d.Document:
        """Return a block of members from its `{` to its `}`; the column of keywords is at least `least` wide."""
        opening, *inner, closing = children
        if not isinstance(opening, Token) or not isinstance(closing, Token):
            raise TypeError(f"braces were expected, not {children!r}")
        if not inner and self.notes.behind(opening) == self.notes.above(closing) == d.NOTHING:
            return d.concatenate(d.Punctuation(" {"), d.Gap(), self.bare(closing))
        rows = align_columns([self._member(child) for child in inner if isinstance(child, Tree)], least)
        body = (part for row in rows for part in (d.HardBreak(), row))
        lines = d.Indent(d.concatenate(*body, self.above_closing(closing)))
        return d.concatenate(self.opening(opening), lines, d.HardBreak(), self.bare(closing))

    def _member(self, tree: Tree) -> MemberLine:
        keyword, *rest = tree.children
        if not isinstance(keyword, Token):
            raise TypeError(f"a keyword was expected, not {keyword!r}")
        above = self.notes.above(keyword)
        if tree.data == "body" and (has_braces(rest[0]) or len(rest) > 1):
            further = self.further(rest[0], rest[1:])
            return MemberLine(above, (), d.concatenate(self.bare(keyword), d.Gap(), self.step(rest[0]), *further))
        if not rest:
            return MemberLine(above, (), self.bare(keyword))
        if tree.data in ("parameter", "refinement"):
            return self._parameter(keyword, rest, above)
        first = ColumnCell(KEYWORD, self.bare(keyword), loose=keyword.value in _LOOSE)
        if tree.data in ("let", "output"):
            return MemberLine(above, (first, ColumnCell("let", self.of(rest[0]))), self.spaced(rest[1:]))
        if is_token(rest[0], "LABEL"):
            return MemberLine(above, (first, ColumnCell("name", self.of(rest[0]))), self.spaced(rest[1:]))
        if len(rest) > 1 and is_token(rest[1], "LABEL"):
            return MemberLine(above, (first, ColumnCell("sensed", self.spaced(rest[:2]))), self.spaced(rest[2:]))
        return MemberLine(above, (first,), self.spaced(rest))

    def _parameter(self, keyword: Token, rest: Sequence[Branch], above: d.Document) -> MemberLine:
        """Return `in name: Type = default  range a .. b`; a type or default is only a cell if more follows it."""
        at = index_of(rest, "LABEL")
        cells = [ColumnCell(KEYWORD, self.bare(keyword)), ColumnCell("name", self.spaced(rest[: at + 1]))]
        type_, *extras = rest[at + 1 :]
        if not extras:
            return MemberLine(above, tuple(cells), self.of(type_))
        has_default = isinstance(extras[0], Tree) and extras[0].data == "default"
        cells.append(ColumnCell("type", self.of(type_), gap=1 if has_default else 2))
        if len(extras) > 1:
            cells.append(ColumnCell("default", self.of(extras[0]), gap=2))
        return MemberLine(above, tuple(cells), self.of(extras[-1]))
