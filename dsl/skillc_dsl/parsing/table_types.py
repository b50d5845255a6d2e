"""The tables of an LALR(1) parser and its lexer as data."""

from __future__ import annotations

import msgspec

WORD = "NAME"
"""The terminal whose texts may be words of the language."""

NESTED = frozenset(
    (
        *("block", "decorator", "if_", "while_", "for_", "with_"),
        *("implies", "not_", "quantified", "parentheses"),
        *("sum", "product", "member", "apply", "list_of"),
    )
)
"""The names of rules that can be nested."""


class Rule(msgspec.Struct, frozen=True, array_like=True):
    """A rule of the grammar: what it makes of the last `size` values is a `origin`.

    `name` is what builders call it. The parts at `spread` are lists that it takes apart. With `replaces_one`, a single
    part stands for itself; with `is_list`, it only lists its parts, for the rule that it stands in.
    """

    origin: str
    name: str
    size: int
    spread: tuple[int, ...]
    replaces_one: bool
    is_list: bool
    is_nested: bool


class Tables(msgspec.Struct, frozen=True, array_like=True):
    """The tables of an LALR(1) parser, and of its lexer.

    `states` has for each symbol the state that follows, or `~n` if the rule `n` is complete; the parser begins in the
    state `start` and has a whole file in `end`. `pattern` has a named group for each terminal that the lexer tries;
    `fixed` has the texts of terminals that have but one, `words` the terminals of texts that are also names.
    """

    start: int
    end: int
    states: tuple[dict[str, int], ...]
    rules: tuple[Rule, ...]
    pattern: str
    fixed: dict[str, str]
    words: dict[str, str]
    ignored: frozenset[str]
