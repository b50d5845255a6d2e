"""Comparisons as other languages write them: told, and read as the one that is meant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from lark import Token

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.lexing import span_of

MEANT: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "=>": ("MORE_EQUAL", ">="),
        "=<": ("LESS_EQUAL", "<="),
        "===": ("EQUALS", "=="),
        "<>": ("UNEQUAL", "!="),
    }
)
"""What stands for which token."""


def foreign_length(tokens: Sequence[Token], index: int) -> int:
    """Return how many tokens from `index` make a comparison of another language, 0 where there is none."""
    first, second = tokens[index], tokens[min(index + 1, len(tokens) - 1)]
    if first in MEANT:
        return 1
    return 2 if first.end_pos == second.start_pos and first + second in MEANT else 0


def comparison(tokens: Sequence[Token], path: str) -> tuple[Token, Diagnostic]:
    """Return the comparison that is meant, and the problem."""
    first, last = tokens[0], tokens[-1]
    written = "".join(tokens)
    kind, text = MEANT[written]
    span = span_of(first, path).to(span_of(last, path))
    token = Token(kind, text, first.start_pos, first.line, first.column, last.end_line, last.end_column, last.end_pos)
    fix = Fix(span, text, f"write `{text}`")
    return token, Diagnostic("syntax", span, f"there is no `{written}`", f"did you mean `{text}`?", fix=fix)
