"""Documents for declarations and whole files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_dsl.formatting import documents as d
from skillc_dsl.formatting.columns import KEYWORD, ColumnCell, MemberLine, align_columns
from skillc_dsl.formatting.inline import index_of
from skillc_dsl.formatting.members import MemberFormatter
from skillc_dsl.parsing.tokens import Branch, Token, Tree

_HEADER = ("use", "prefix", "import_")
_BLOCKS = ("skill", "impl", "task", "test")
_WORD = 4
"""The minimum width of the column of keywords in a skill, such as `pre` and `hold`."""


class FileFormatter(MemberFormatter):
    """Creates the document of a file."""

    def file(self, tree: Tree) -> d.Document:
        """Return the document of a file, with blank lines added below the header and around declarations in braces."""
        parts: list[d.Document] = []
        before = ""
        for trees in self._paragraphs([child for child in tree.children if isinstance(child, Tree)]):
            kind = str(trees[0].data)
            if before in _BLOCKS or kind in _BLOCKS or (before in _HEADER and kind not in _HEADER):
                parts.append(d.BlankLine())
            for part in self._paragraph(trees):
                parts += [part, d.HardBreak()]
            before = kind
        return d.concatenate(*parts, self.notes.last)

    def _paragraphs(self, trees: Sequence[Tree]) -> Iterator[list[Tree]]:
        """Yield the header lines and declarations in groups; only consecutive terms of the vocabulary share a group."""
        paragraph: list[Tree] = []
        for tree in trees:
            alone = tree.data in _HEADER + _BLOCKS or (paragraph and paragraph[0].data in _HEADER + _BLOCKS)
            if paragraph and (alone or _has_blank(self.notes.above(_keyword(tree)))):
                yield paragraph
                paragraph = []
            paragraph.append(tree)
        if paragraph:
            yield paragraph

    def _paragraph(self, trees: Sequence[Tree]) -> Iterator[d.Document]:
        first = trees[0]
        if first.data in _BLOCKS:
            start = index_of(first.children, "LBRACE")
            braces = self.members(first.children[start:], _WORD if first.data == "skill" else 0)
            yield d.concatenate(self._head(first.children[:start]), braces)
        elif first.data in _HEADER:
            yield self.spaced(first.children)
        else:
            yield from align_columns([self._term(tree) for tree in trees])

    def _head(self, children: Sequence[Branch]) -> d.Document:
        """Return what stands before the braces; no space is between a name and its parameters."""
        start = index_of(children, "LPAR")
        if start < 0:
            return self.spaced(children)
        return d.concatenate(self.spaced(children[:start]), self.bracketed(children[start:]))

    def _term(self, tree: Tree) -> MemberLine:
        """Return the declaration of a class, a relation, a property or a function."""
        head, rest = _keyword(tree), tree.children[1:]
        above, first = self.notes.above(head), ColumnCell(KEYWORD, self.bare(head))
        if tree.data == "enum":
            return MemberLine(above, (first,), self._enum(rest))
        if tree.data == "class_":
            content, last = self._class(rest)
        else:
            content, last = self._signature(rest)
        if tree.data in ("function", "property") or not last or _is_tree(rest[-1], "definition"):
            return MemberLine(above, (first,), d.concatenate(content, *last))
        return MemberLine(above, (first, ColumnCell(str(tree.data), content, gap=2)), d.concatenate(*last[1:]))

    def _class(self, rest: Sequence[Branch]) -> tuple[d.Document, list[d.Document]]:
        """Return the name of a class with its parents, and the disjoint classes."""
        *content, last = rest
        if _is_tree(last, "disjoint"):
            return self.spaced(content), [d.Gap(), self.of(last)]
        return self.spaced(rest), []

    def _enum(self, rest: Sequence[Branch]) -> d.Document:
        """Return the name of an enumeration with its values, on separate lines if they do not fit one."""
        name, opening, *values, closing = rest
        if not isinstance(opening, Token) or not isinstance(closing, Token):
            raise TypeError(f"braces were expected, not {rest!r}")
        parts: list[d.Document] = [d.SoftBreak()]
        for value in values:
            parts += [self.comma(value), d.SoftBreak()] if isinstance(value, Token) else [self.of(value)]
        head = d.concatenate(d.Punctuation(" {"), self.notes.behind(opening))
        inside = d.Indent(d.concatenate(head, *parts, self.above_closing(closing)))
        return d.DocumentGroup(d.concatenate(self.of(name), inside, d.SoftBreak(), self.bare(closing)))

    def _signature(self, rest: Sequence[Branch]) -> tuple[d.Document, list[d.Document]]:
        """Return the name with its brackets, and the rest; no space precedes the `:` of a property."""
        start, end = index_of(rest, "LPAR"), index_of(rest, "RPAR")
        content = d.concatenate(self.of(rest[0]), self.bracketed(rest[start : end + 1]))
        tail = rest[end + 1 :]
        colon = index_of(tail, "COLON")
        if colon == 0:
            return content, [self.of(tail[0]), d.Gap(), self.spaced(tail[1:])]
        return content, [d.Gap(), self.spaced(tail)] if tail else []


def _keyword(tree: Tree) -> Token:
    """Return the first keyword of a declaration."""
    first = tree.children[0]
    if not isinstance(first, Token):
        raise TypeError(f"a keyword was expected, not {first!r}")
    return first


def _is_tree(branch: Branch, rule: str) -> bool:
    return isinstance(branch, Tree) and branch.data == rule


def _has_blank(above: d.Document) -> bool:
    return isinstance(above, d.Concatenation) and any(isinstance(part, d.BlankLine) for part in above.parts)
