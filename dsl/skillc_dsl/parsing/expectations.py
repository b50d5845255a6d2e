"""Descriptions of expected tokens for messages."""

from __future__ import annotations

import functools
from collections.abc import Iterable

import msgspec

from skillc_dsl.parsing.grammar import END, fixed_texts, list_following_terminals
from skillc_dsl.parsing.tokens import Token


class Phrase(msgspec.Struct, frozen=True):
    """A description of the terminals in `covers`, used if all terminals in `signs` fit."""

    text: str
    signs: frozenset[str]
    covers: frozenset[str]


@functools.cache
def _phrases() -> tuple[Phrase, ...]:
    """Return the phrases in order of precedence; the terminals that they cover are derived from the grammar."""
    impl = "IMPL NAME OF NAME LBRACE"
    values = list_following_terminals(f"{impl} LET NAME EQUAL")
    conditions = list_following_terminals(f"{impl} DO IF")
    relations = name_terminals() & list_following_terminals(f"{impl} DO IF NAME")
    operators = _set("PLUS MINUS STAR SLASH DOT LPAR")
    compared = _set("EQUALS UNEQUAL LESS LESS_EQUAL MORE MORE_EQUAL PLUS_EQUAL MINUS_EQUAL COLON_EQUAL")
    table = (
        ("a declaration such as `skill` or `impl`", "CLASS SKILL", list_following_terminals("") - {END}),
        (
            "a member of a skill, such as `in` or `pre`",
            "IN OPT PRE",
            list_following_terminals("SKILL NAME LBRACE") - {"RBRACE"},
        ),
        (
            "a member of an implementation, such as `let` or `do`",
            "LET RUN",
            list_following_terminals(impl) - {"RBRACE"},
        ),
        (
            "a member of a test, such as `start` or `expect`",
            "START EXPECT DO",
            _set("SCENE GOAL ALWAYS DO START EXPECT"),
        ),
        (
            "a member of a task, such as `scene` or `goal`",
            "SCENE GOAL DO",
            _set("SCENE BACKEND GOAL ALWAYS WITHIN MINIMISE DO"),
        ),
        ("a condition", "NOT EXISTS NUMBER", conditions | values),
        ("a step, such as `seq` or a call", "SEQ IF", list_following_terminals(f"{impl} DO")),
        ("a value", "NUMBER QUANTITY STRING", values | name_terminals()),
        ("a relation", "NAME HAS", relations | {"HAS", "IS"}),
        ("a name", "NAME", name_terminals()),
        ("a comparison such as `==`", "EQUALS LESS", compared),
        ("a connective such as `and`", "AND OR", _set("AND OR IMPLIES") | operators),
        ("an operator such as `+`", "PLUS STAR", operators),
        ("a name with its `:`", "LABEL", _set("LABEL")),
        ("a number", "NUMBER", _set("NUMBER MINUS")),
        ("a quantity", "QUANTITY", _set("QUANTITY")),
        ('a text in `"`', "STRING", _set("STRING")),
        ("an address such as `<http://example.org/lab#>`", "IRI", _set("IRI")),
        ("the end of the file", END, _set(END)),
    )
    return tuple(Phrase(text, _set(signs), covers) for text, signs, covers in table)


@functools.cache
def name_terminals() -> frozenset[str]:
    """Return all terminals that may be a name."""
    return list_following_terminals("USE")


def explain_where_it_belongs(token: Token) -> str:
    """Return help that names the declarations a member belongs to, or an empty string for other constructs."""
    homes = (
        ("a `skill`", "SKILL NAME LBRACE"),
        ("an `impl`", "IMPL NAME OF NAME LBRACE"),
        ("a `task`", "TASK NAME LBRACE"),
        ("a `test`", "TEST NAME LBRACE"),
    )
    fitting = [
        kind for kind, start in homes if token.type != "RBRACE" and token.type in list_following_terminals(start)
    ]
    return f"`{token}` belongs in {' or '.join(fitting)}" if fitting else ""


def _set(terminals: str) -> frozenset[str]:
    return frozenset(terminals.split())


def describe_terminals(terminals: Iterable[str]) -> str:
    """Return a description of `terminals` for a message, such as `a value, a relation or `}``."""
    left = set(terminals)
    if len(left) > 1:
        left.discard("OF")  # the grammar accepts it after every type, but it is only meaningful after `Vector`
    phrases: list[str] = []
    for phrase in _phrases():
        if phrase.signs <= left:
            phrases.append(phrase.text)
            left -= phrase.covers
    marks = sorted(f"`{fixed_texts()[terminal]}`" for terminal in left if terminal in fixed_texts())
    *others, last = [*marks, *phrases] or ["nothing more"]
    return f"{', '.join(others)} or {last}" if others else last


def describe_token(token: Token) -> str:
    """Return a description of `token` for a message."""
    if token.type == END:
        return "the end of the file"
    return f"`{token}`" if token else "a `}`"
