"""Reports a second step after `do`, which takes one: the `seq { }` around them is missing."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.parsing.grammar import begins_line, can_continue
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.tokens import Token, Tree


def report_second_step(
    states: Sequence[int], values: Sequence[Token | Tree], tokens: Sequence[Token], index: int, path: str
) -> Diagnostic | None:
    """Return the problem if the token at `index` begins a step below the one of a `do` that is still open."""
    level = next((at for at, value in reversed([*enumerate(values)]) if _is_do(value)), None)
    following = [token.type for token in tokens[index : index + 2]]
    if level is None or not begins_line(tokens, index) or not can_continue(states[: level + 2], *following):
        return None
    if any(isinstance(value, Token) and value.type == "LBRACE" for value in values[level:]):
        return None
    return Diagnostic(
        "syntax",
        token_span(tokens[index], path),
        f"`do` takes one step, and `{tokens[index]}` is a second one",
        "put the steps between `do seq {` and `}`",
        labels=(Label(token_span(values[level], path), "write `do seq {` here"),),  # type: ignore[arg-type]
    )


def _is_do(value: Token | Tree) -> bool:
    return isinstance(value, Token) and value.type == "DO"
