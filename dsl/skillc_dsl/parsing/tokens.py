"""Tokens, and trees of them as the grammar has them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias


class Token(str):
    """A piece of the text: `type` is its terminal.

    Lines and columns count from 1, positions from 0; ends are exclusive. A token that does not stand in the text has
    None for its places.
    """

    __slots__ = ("column", "end_column", "end_line", "end_pos", "line", "start_pos", "type")

    def __new__(
        cls,
        type: str,
        text: str,
        start_pos: int | None = None,
        line: int | None = None,
        column: int | None = None,
        end_line: int | None = None,
        end_column: int | None = None,
        end_pos: int | None = None,
    ) -> Token:
        """Return a token with the text, whatever its type."""
        self = str.__new__(cls, text)
        self.type = type
        self.start_pos, self.line, self.column = start_pos, line, column
        self.end_line, self.end_column, self.end_pos = end_line, end_column, end_pos
        return self

    @property
    def value(self) -> str:
        """The text alone."""
        return str(self)

    type: str
    start_pos: int | None
    line: int | None
    column: int | None
    end_line: int | None
    end_column: int | None
    end_pos: int | None


class Tree:
    """What a rule of the grammar derives; `data` is the name of the rule, or of the alternative that has one."""

    __slots__ = ("children", "data")

    def __init__(self, data: str, children: list[Branch]) -> None:
        self.data = data
        self.children = children

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Tree) and (self.data, self.children) == (other.data, other.children)

    __hash__ = None  # type: ignore[assignment]

    def trees(self) -> Iterator[Tree]:
        """Yield this tree and all trees in it, each before those in it."""
        waiting = [self]
        while waiting:
            tree = waiting.pop()
            yield tree
            waiting += [child for child in reversed(tree.children) if isinstance(child, Tree)]

    def tokens(self) -> Iterator[Token]:
        """Yield all tokens in their order."""
        waiting: list[Branch] = [self]
        while waiting:
            branch = waiting.pop()
            if isinstance(branch, Token):
                yield branch
            else:
                waiting += reversed(branch.children)


Branch: TypeAlias = Token | Tree


def tokens_in(branches: Sequence[Branch]) -> Iterator[Token]:
    """Yield all tokens of branches in their order."""
    for branch in branches:
        yield from (branch,) if isinstance(branch, Token) else branch.tokens()
