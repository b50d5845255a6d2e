"""The base of all builders: places, source text, documentation."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any, Protocol, TypeVar

import msgspec

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.tokens import Token, Tree
from skillc_dsl.source import Source, Span

T = TypeVar("T")
_STRING_OR_COMMENT = re.compile(r'("[^"\n]*")|#[^\n]*')


class Spanned(Protocol):
    """A piece of the syntax tree."""

    @property
    def span(self) -> Span:
        """The place of the piece."""
        ...


Child = Token | Spanned


class MemberPart(msgspec.Struct, frozen=True):
    """A piece of a member that has no type of its own in the syntax tree, such as `= value` or `{ nodes }`."""

    rule: str
    children: tuple[Child, ...]
    span: Span


class MemberParts(msgspec.Struct, frozen=True):
    """Members of the syntax tree that one member as written stands for."""

    members: tuple[Spanned, ...]
    span: Span


class TreeBuilder:
    """Builds syntax from the leaves up; each method has the name of the grammar rule whose children it gets."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.lines = source.text.split("\n")
        self.starts = [0]
        for line in self.lines:
            self.starts.append(self.starts[-1] + len(line) + 1)
        self.problems: list[Diagnostic] = []

    def make(self, rule: str, children: list[Any]) -> Spanned:
        """Return what a rule stands for, from what its parts do."""
        made: Spanned = getattr(self, rule)(children)
        return made

    def build(self, tree: Tree) -> Spanned:
        """Return what a tree stands for."""
        made: dict[int, Spanned] = {}
        for each in reversed([*tree.trees()]):
            children = [child if isinstance(child, Token) else made.pop(id(child)) for child in each.children]
            made[id(each)] = self.make(each.data, children)
        return made[id(tree)]

    def place(self, child: Child) -> Span:
        """Return the place of a token or a piece of syntax."""
        return token_span(child, self.source.path) if isinstance(child, Token) else child.span

    def over(self, children: Sequence[Child]) -> Span:
        """Return the span from the first of `children` to the last."""
        first = self.place(children[0])
        return first if len(children) == 1 else first.to(self.place(children[-1]))

    def part(self, rule: str, children: Sequence[Child]) -> MemberPart:
        """Return `children` as a part with the name of their rule."""
        return MemberPart(rule, tuple(children), self.over(children))

    def written(self, span: Span) -> str:
        """Return the text of `span` on one line, without comments."""
        start = self.starts[span.line - 1] + span.column - 1
        end = self.starts[span.end_line - 1] + span.end_column - 1
        return " ".join(_STRING_OR_COMMENT.sub(r"\1", self.source.text[start:end]).split())

    def doc(self, span: Span) -> str:
        """Return the `##` lines right above `span`, without the `##`; empty if `span` does not begin its line."""
        first = span.line - 1
        if self.lines[first][: span.column - 1].strip():
            return ""
        while first > 0 and self.lines[first - 1].lstrip().startswith("##"):
            first -= 1
        found = [line.strip()[2:] for line in self.lines[first : span.line - 1]]
        return "\n".join(line.removeprefix(" ") for line in found)


def children_of_type(children: Iterable[Child], kind: type[T]) -> tuple[T, ...]:
    """Return the children of one type in order."""
    return tuple(child for child in children if isinstance(child, kind))


def first_of_type(children: Iterable[Child], kind: type[T]) -> T | None:
    """Return the first child of one type, or None."""
    return next((child for child in children if isinstance(child, kind)), None)


def find_part(children: Iterable[Child], rule: str) -> MemberPart | None:
    """Return the part of a rule, or None if it is not present."""
    return next((child for child in children if isinstance(child, MemberPart) and child.rule == rule), None)


def keyword_at(children: Sequence[Child], index: int) -> str:
    """Return the token at `index` as text, or an empty string if the child is not a token."""
    child = children[index] if index < len(children) else None
    return child.value if isinstance(child, Token) else ""
