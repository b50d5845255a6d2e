"""Reports declarations whose name is a word of the language where it is read, so that it could never be used."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.editions import NEWEST
from skillc_dsl.parsing.expectations import name_terminals
from skillc_dsl.parsing.grammar import can_continue, list_following_terminals
from skillc_dsl.parsing.lexer import token_span
from skillc_dsl.parsing.reserved import NAME
from skillc_dsl.parsing.tables import load_tables
from skillc_dsl.parsing.token_repairs import join_tokens
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source

_NAMED = MappingProxyType(
    {
        "CLASS": "class",
        "ENUM": "enumeration",
        "RELATION": "relation",
        "PROPERTY": "property",
        "FUNCTION": "function",
        "SKILL": "skill",
        "IMPL": "implementation",
        "TASK": "task",
        "TEST": "test",
        "LET": "value",
        "FOR": "variable",
    }
)
"""What a word after a token is the name of."""
_LABELLED = MappingProxyType(
    {
        **dict.fromkeys(("IN", "OPT", "INFER", "ANY", "OUT", "SOME"), "parameter"),
        **dict.fromkeys(("EXISTS", "FORALL"), "variable"),
    }
)
"""What a label after a token is the name of."""
_IN_HEADS = MappingProxyType({"FUNCTION": "parameter of a function", "TASK": "parameter"})
"""What a label in a head is the name of; that of a function is never read."""
_NAMES_BEFORE = frozenset(("of",))
"""Words that could be names of values in older editions: `pre of` came with the newest one."""
_VALUES = frozenset(("parameter", "variable", "value", "function"))


def has_reserved_name(tokens: Sequence[Token], edition: int) -> bool:
    """Whether anything is declared whose name is a word of an edition of the language."""
    return any(True for _ in _find(tokens, edition))


def rename_reserved(tokens: tuple[Token, ...], source: Source) -> Outcome[tuple[Token, ...]]:
    """Return the tokens, with names in place of the words of the language that are declared as names."""
    problems: list[Diagnostic] = []
    renamed = list(tokens)
    for index, kind, word in _find(tokens, source.edition):
        token = tokens[index]
        message = f"`{word}` is a word of the language, so no {kind} can be called `{word}`"
        problems.append(
            Diagnostic(NAME, token_span(token, source.path), message, f"choose another name, such as `own_{word}`")
        )
        if token.type != "LABEL":
            renamed[index] = join_tokens("NAME", token, token, token.value)
    return Outcome(tuple(renamed), tuple(problems))


def declared_words(tokens: Sequence[Token], edition: int) -> Mapping[str, str]:
    """Return the words of the language that are declared as names, and what they are the names of."""
    return {word: kind for _, kind, word in _find(tokens, edition)}


def _find(tokens: Sequence[Token], edition: int) -> Iterator[tuple[int, str, str]]:
    """Yield the index of each such name, what it is the name of, and the word."""
    reserved, terminals = _reserved(), load_tables().words
    names = _NAMES_BEFORE if edition < NEWEST else frozenset()
    head, before = "", ""
    for index, token in enumerate(tokens):
        if token.type == "LABEL":
            kind = _IN_HEADS.get(head) or _LABELLED.get(before)
            word = token[:-1]
        else:
            kind, word = _NAMED.get(before), token.value
        if before == "IMPL" and [each.type for each in tokens[index + 1 : index + 2]] != ["OF"]:
            kind = None  # its name is what is missing
        if before in ("ENUM", "TEST") and [each.type for each in tokens[index + 1 : index + 2]] != ["LBRACE"]:
            kind = None  # it is a name itself
        if kind is not None and terminals.get(word) in reserved[kind] and word not in names:
            yield index, kind, word
        before = token.type
        head = before if before in _IN_HEADS else "" if before in ("RPAR", "LBRACE", "LET") else head


@functools.cache
def _reserved() -> MappingProxyType[str, frozenset[str]]:
    """Return the terminals of the words that cannot be a name, by what it is the name of."""
    words = frozenset(load_tables().words.values())
    values = list_following_terminals("IMPL NAME OF NAME LBRACE LET NAME EQUAL") & name_terminals()
    kinds = (*_NAMED.values(), *_LABELLED.values(), *_IN_HEADS.values())
    names = dict.fromkeys(kinds, words - name_terminals())
    never_called = frozenset(each for each in words if not _can_be_called(each))
    return MappingProxyType({**names, **dict.fromkeys(_VALUES, words - values), "skill": never_called})


def _can_be_called(terminal: str) -> bool:
    """Whether a step can call a skill of this name."""
    body, call = "IMPL NAME OF NAME LBRACE DO", "LSQB NAME RSQB LPAR"
    return can_continue([load_tables().start], *body.split(), terminal, *call.split())
