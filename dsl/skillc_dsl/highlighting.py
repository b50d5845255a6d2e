"""A Pygments lexer for skill files, with the tokens of the table."""

from __future__ import annotations

from collections.abc import Iterator

from pygments.lexer import Lexer  # type: ignore[import-untyped]
from pygments.token import (  # type: ignore[import-untyped]
    Comment,
    Keyword,
    Name,
    Number,
    Operator,
    Punctuation,
    String,
    Text,
    _TokenType,
)

from skillc_dsl.token_table import TYPES, TokenKind, keyword_group, scan_tokens

_COLOURS: dict[TokenKind, _TokenType] = {
    "documentation": String.Doc,
    "comment": Comment.Single,
    "text": String.Double,
    "address": String.Other,
    "label": Name.Label,
    "qualified name": Name,
    "quantity": Number,
    "number": Number,
    "name": Name,
    "operator": Operator,
    "punctuation": Punctuation,
}


class SkillLexer(Lexer):  # type: ignore[misc]
    """Finds the tokens of the skill language; a keyword that is a property's name after a `.` is a name."""

    name = "Skill"
    aliases = ("skill",)
    filenames = ("*.skill",)

    def get_tokens_unprocessed(self, text: str) -> Iterator[tuple[int, _TokenType, str]]:
        """Yield each piece of `text` with its position and its kind."""
        end, before = 0, ""
        for kind, start, token in scan_tokens(text):
            if start > end:
                yield end, Text, text[end:start]
            yield start, _colour(kind, token, before), token
            end, before = start + len(token), token
        if end < len(text):
            yield end, Text, text[end:]


def _colour(kind: TokenKind, token: str, before: str) -> _TokenType:
    """Return the kind of a token, given the one before it."""
    if kind != "name" or before == ".":
        return _COLOURS[kind]
    match keyword_group(token):
        case None:
            return Keyword.Type if token in TYPES else Name
        case "declaration":
            return Keyword.Declaration
        case "logic":
            return Operator.Word
        case "constant":
            return Keyword.Constant
        case _:
            return Keyword
