"""How each construct of the language is written, for messages about what does not fit in it."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_dsl.descriptions.constructs import list_forms, terminal
from skillc_dsl.parsing.tokens import Token, Tree

WRITTEN = {terminal(word): form for word, form in list_forms().items()}
"""The form of what begins with each terminal."""


def show_construct(values: Sequence[Token | Tree]) -> str:
    """Return help with the form of the construct that the parser has begun, or an empty string."""
    for value in reversed(values):
        kind = value.type if isinstance(value, Token) else ""
        if kind in ("LBRACE", "RBRACE") or (isinstance(value, Tree) and value.data.endswith("_star")):
            return ""
        if kind in WRITTEN:
            return f"write `{WRITTEN[kind]}`"
    return ""
