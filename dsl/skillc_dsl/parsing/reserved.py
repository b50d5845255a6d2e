"""Reports relations that are called like a word which may follow a value, such as `pause`, and have no prefix."""

from __future__ import annotations

import functools
from collections.abc import Sequence

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.parsing.expectations import name_terminals
from skillc_dsl.parsing.grammar import begins_line, can_continue, list_following_terminals
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Span

NAME = "reserved-word"
_ONLY_A_RELATION = "SENSED"
"""A word that may be the name of a relation, but neither that of a called skill nor a keyword after a value."""
_BETWEEN_VALUES = "IS"
"""A word that stands where a relation does."""


@functools.cache
def _reserved() -> frozenset[str]:
    """Return the words that are legal names, but not where a relation stands between two values."""
    return name_terminals() - list_following_terminals("IMPL NAME OF NAME LBRACE DO IF NAME")


def report_reserved(states: Sequence[int], tokens: Sequence[Token], index: int, path: str) -> Diagnostic | None:
    """Return the problem if the token at `index` is such a relation, after the input that led to the parser's `states`.

    It is one if it continues its line, if the next token cannot follow the word, and if it can follow a relation.
    """
    token = tokens[index]
    if token.type not in _reserved() or begins_line(tokens, index):
        return None
    after = tokens[index + 1].type
    if can_continue(states, token.type, after) or not can_continue(states, _ONLY_A_RELATION, after):
        return None
    return needs_prefix(token, token_span(token, path)) if can_continue(states, _BETWEEN_VALUES, "NAME") else None


def needs_prefix(word: str, span: Span) -> Diagnostic:
    """Return the problem of a word that is meant as a relation."""
    message = f"`{word}` is a word of the language here, so a relation of that name needs its prefix"
    return Diagnostic(NAME, span, message, f"write the prefix of its vocabulary: `prefix:{word}`")
