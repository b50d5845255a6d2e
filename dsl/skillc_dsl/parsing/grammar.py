"""Questions about the grammar: what fits after what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_dsl.parsing.tables import load_tables
from skillc_dsl.parsing.tokens import Token

END = "$END"
DECLARATIONS = frozenset({"CLASS", "RELATION", "PROPERTY", "FUNCTION", "SKILL", "IMPL", "TASK", "TEST", "ENUM"})


def fixed_texts() -> Mapping[str, str]:
    """Return the text of each terminal with a fixed text."""
    return load_tables().fixed


def shift(stack: Sequence[int], terminal: str) -> list[int] | None:
    """Return the stack of parser states after shifting `terminal`, or None if it does not fit."""
    tables, result = load_tables(), list(stack)
    while True:
        target = tables.states[result[-1]].get(terminal)
        if target is None:
            return None
        if target >= 0:
            return [*result, target]
        rule = tables.rules[~target]
        if rule.size:
            del result[-rule.size :]
        result.append(tables.states[result[-1]][rule.origin])
        if terminal == END and result[-1] == tables.end:
            return result


def can_continue(stack: Sequence[int], *terminals: str) -> bool:
    """Whether the parser accepts `terminals`, in this order, after the input that led to `stack`."""
    states: Sequence[int] | None = stack
    for terminal in terminals:
        states = None if states is None else shift(states, terminal)
    return states is not None


def list_fitting_terminals(stack: Sequence[int]) -> frozenset[str]:
    """Return all terminals that the parser accepts after the input that led to `stack`."""
    following = load_tables().states[stack[-1]]
    return frozenset(t for t in following if (t.isupper() or t == END) and shift(stack, t))


def list_following_terminals(terminals: str) -> frozenset[str]:
    """Return all terminals that fit after `terminals`, separated by spaces, at the start of a file."""
    stack = [load_tables().start]
    for terminal in terminals.split():
        stack = shift(stack, terminal) or stack
    return list_fitting_terminals(stack)


def begins_line(tokens: Sequence[Token], index: int) -> bool:
    """Whether the token at `index` is the first on its line; true for the end of the file."""
    return index == 0 or tokens[index].type == END or tokens[index].line != tokens[index - 1].end_line
