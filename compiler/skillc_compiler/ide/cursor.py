"""The position of the cursor: in a comment, in a string, or after tokens of a declaration; also in broken files."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TypeAlias

import msgspec

from skillc_dsl.parsing.grammar import END, can_continue, shift
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.tables import load_tables
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source, Span

_HEAD = re.compile(
    r"\s*(class|relation|property|function|skill|impl|task|(?:test|enum)(?=\s+\w+\s*\{))\b|(use|prefix|import)\b"
)
_NUMBER = re.compile(r"(?<!\w)(?<!\w-)(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)(?:[ \t]+|(?=[^\W\d]))([^\W\d][\w/]*)?$")
_WORD = re.compile(r"(?:[^\W\d]\w*:)?[^\W\d][\w-]*$|[^\W\d]\w*:$|[^\W\d]\w*$")
_OPEN_BRACE = re.compile(r"(?<!\{)(?:\{\{)*\{(?:(?P<of>[^\W\d]\w*)\.)?(?P<word>[^\W\d]\w*|)$")
_BARE = re.compile(r"[^\W\d]\w*$")
LONGEST_WORD = 200
"""The number of characters before the cursor in which the word at it, and a number before that, are looked for."""


class InComment(msgspec.Struct, frozen=True):
    """In a comment; `text` is the comment from the `#` to the cursor."""

    text: str
    word: Span


class InText(msgspec.Struct, frozen=True):
    """In a string; `opener` is the word before the string (`import`, `scene`, `python`)."""

    opener: str
    word: Span


class InBraces(msgspec.Struct, frozen=True):
    """Behind an open brace in a string; `around` is the place of the string.

    `word` is the name behind the brace, or, behind a dot, that of a member of the name `of`.
    """

    around: InCode
    word: Span
    of: str


class InCode(msgspec.Struct, frozen=True):
    """In code, at the word `word`.

    `before` are the tokens of the declaration before the word; the first one is the keyword of the declaration, if
    the cursor is in one. `states` is the stack of parser states after them. `number` is true if the word follows a
    number, `begins_line` if it is the first on its line.
    """

    before: tuple[Token, ...]
    states: tuple[int, ...]
    number: bool
    begins_line: bool
    word: Span

    @property
    def types(self) -> tuple[str, ...]:
        """The types of the tokens in `before`."""
        return tuple(token.type for token in self.before)

    def fits(self, *terminals: str) -> bool:
        """Whether the grammar accepts these terminals, in this order, at the cursor."""
        return can_continue(self.states, *terminals)


Cursor: TypeAlias = InComment | InText | InBraces | InCode


def locate_cursor(source: Source, line: int, column: int) -> Cursor:
    """Return the kind of position at `line` and `column`, both counted from 1."""
    path, lines = source.path, source.text.split("\n")
    left = (lines[line - 1] if line <= len(lines) else "")[: column - 1]
    near = max(len(left) - LONGEST_WORD, 0)
    opened = _opened(left)
    if opened is not None and left[opened] == "#":
        word = _BARE.search(left, near)
        return InComment(left[opened:], _span(path, line, word.start() if word else len(left), len(left)))
    if opened is not None:
        return _in_string(source, line, left, opened)
    number = _NUMBER.search(left, near)
    word = (_BARE if number and not number[2] else _WORD).search(left, near)
    start = number.start(2) if number and number[2] else word.start() if word else len(left)
    first = _first_line(lines, line)
    before = _tokens(source._replace(text="\n".join((*lines[first - 1 : line - 1], left[:start]))))
    return InCode(
        before,
        parser_states_after(before),
        number is not None,
        not left[:start].strip(),
        _span(path, line, start, len(left)),
    )


def _in_string(source: Source, line: int, left: str, opened: int) -> InText | InBraces:
    """Return the position in the string that begins at the index `opened` of a line."""
    brace, around = _OPEN_BRACE.search(left, opened), locate_cursor(source, line, opened + 1)
    if brace is not None and isinstance(around, InCode):
        return InBraces(around, _span(source.path, line, brace.start("word"), len(left)), brace["of"] or "")
    words = left[:opened].split()
    return InText(words[-1] if words else "", _span(source.path, line, opened + 1, len(left)))


def parser_states_after(tokens: Sequence[Token]) -> tuple[int, ...]:
    """Return the stack of parser states after `tokens`.

    A name that does not fit is skipped; any other token that does not fit closes the constructs that it may end."""
    states: list[int] = [load_tables().start]
    for token in tokens:
        after = shift(states, token.type)
        if after is not None:
            states = after
        elif token.type not in ("NAME", "QNAME"):
            states = _resumed(states, token.type)
    return tuple(states)


def _resumed(states: list[int], terminal: str) -> list[int]:
    """Drop as few states as needed for `terminal` to fit, then shift it; without a fit, return the states unchanged."""
    for kept in range(len(states) - 1, 0, -1):
        after = shift(states[:kept], terminal)
        if after is not None:
            return after
    return states


def _opened(left: str) -> int | None:
    """Return the index where a string or comment begins that is still open at the end of `left`, else None."""
    opened: int | None = None
    for index, character in enumerate(left):
        if opened is None and character == "#":
            return index
        if character == '"':
            opened = index if opened is None else None
    return opened


def _first_line(lines: Sequence[str], line: int) -> int:
    """Return the line on which the declaration, `use` or `import` around `line` begins, or else `line`."""
    return next((number for number in range(min(line, len(lines)), 0, -1) if _HEAD.match(lines[number - 1])), line)


def _tokens(source: Source) -> tuple[Token, ...]:
    return tuple(token for token in tokenize(source).value if token.type != END)


def _span(path: str, line: int, start: int, end: int) -> Span:
    return Span(path, line, start + 1, line, end + 1)
