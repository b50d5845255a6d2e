"""Comments and blank lines, each attached to a token."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Iterator, Mapping, Sequence

import msgspec

from skillc_dsl.comments import Comment, find_comments
from skillc_dsl.formatting.documents import NOTHING, BlankLine, CommentLine, Concatenation, Document, TrailingComment
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source

_MARKS = ("COMMA", "LBRACE")


class Notes(msgspec.Struct, frozen=True):
    """The comments and blank lines around each token, by the start position of the token; `last` ends the file."""

    before: Mapping[int, Document]
    after: Mapping[int, Document]
    last: Document

    def above(self, token: Token) -> Document:
        """Return the comments above a token, with the blank lines between and below them."""
        return self.before.get(token.start_pos or 0, NOTHING)

    def behind(self, token: Token) -> Document:
        """Return the comment after a token on the same line."""
        return self.after.get(token.start_pos or 0, NOTHING)


def attach_comments(source: Source, tokens: Sequence[Token], statements: Collection[int]) -> Notes:
    """Attach each comment to the token before it on the same line, else to the next token.

    `statements` are the positions of tokens above which a blank line may stand.
    """
    lines = source.text.split("\n")
    before, after = _attached(source, tokens, lines)
    last = Concatenation(tuple(before.pop(len(tokens), ())))
    for index, token in enumerate(tokens):
        first = index == 0 or tokens[index - 1].end_line != token.line
        if first and token.start_pos in statements and _blank_above(lines, token.line or 1):
            before.setdefault(index, []).append(BlankLine())
    above = {tokens[index].start_pos or 0: Concatenation(tuple(parts)) for index, parts in before.items()}
    return Notes(above, after, last)


def _attached(
    source: Source, tokens: Sequence[Token], lines: Sequence[str]
) -> tuple[dict[int, list[Document]], dict[int, Document]]:
    """Return the comments above tokens, by index of the token, and those behind tokens, by its start position.

    Punctuation stays on the line of the preceding token, so that a comment before it is moved behind it.
    """
    starts = [(token.line or 1, token.column or 1) for token in tokens]
    before: dict[int, list[Document]] = {}
    after: dict[int, Document] = {}
    for comment in find_comments(source):
        index = found = bisect_left(starts, (comment.span.line, comment.span.column))
        while index < len(tokens) and tokens[index].type in _MARKS:
            index += 1
        last = tokens[index - 1] if index else None
        if last is not None and not comment.alone and last.start_pos not in after and index not in before:
            after[last.start_pos or 0] = TrailingComment(comment.written)
        else:
            entered = last is not None and last.type == "LBRACE" and tokens[index].type != "RBRACE"
            moved = index > found or not comment.alone
            before.setdefault(index, []).extend(_note(comment, lines, documents=entered and moved))
    return before, after


def _note(comment: Comment, lines: Sequence[str], *, documents: bool) -> Iterator[Document]:
    """Yield a comment with the blank line above it.

    `documents` is true if a `##` comment was moved and would document the next line; a blank line prevents that."""
    if _blank_above(lines, comment.span.line) and comment.alone:
        yield BlankLine()
    yield CommentLine(comment.written)
    if documents and comment.written.startswith("##"):
        yield BlankLine()


def _blank_above(lines: Sequence[str], line: int) -> bool:
    return line > 1 and not lines[line - 2].strip()
