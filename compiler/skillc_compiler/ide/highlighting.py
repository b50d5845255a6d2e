"""Semantic highlighting: names are coloured by the kind of their symbol, other words by the kind of token."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal, TypeAlias, assert_never

import msgspec
from msgspec import structs

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.symbols import (
    AggregateSymbol,
    ChoiceSymbol,
    FailurePartSymbol,
    FileSymbol,
    FunctionSymbol,
    ImplementationSymbol,
    IndividualSymbol,
    LabelSymbol,
    LocalSymbol,
    Occurrence,
    ParameterSymbol,
    PrefixSymbol,
    QuantitySymbol,
    SceneSymbol,
    SkillSymbol,
    Symbol,
    TaskSymbol,
    TermSymbol,
    TypeSymbol,
)
from skillc_dsl.source import Span
from skillc_dsl.token_table import PATTERNS, keyword_group

WordKind: TypeAlias = Literal[
    "namespace", "class", "type", "method", "property", "function", "interface", "parameter", "variable",
    "enumMember", "decorator", "keyword", "comment", "string", "number", "operator",
]  # fmt: skip

_TOKEN = re.compile("|".join(f"(?P<{kind.replace(' ', '_')}>{pattern})" for kind, pattern in PATTERNS.items()))
_PLAIN: dict[str, WordKind] = {
    "documentation": "comment",
    "comment": "comment",
    "text": "string",
    "address": "string",
    "quantity": "number",
    "number": "number",
    "operator": "operator",
}


class HighlightedWord(msgspec.Struct, frozen=True):
    """A coloured word on a single line."""

    span: Span
    kind: WordKind
    declares: bool = False


def highlight_words(analysis: Analysis, path: str) -> tuple[HighlightedWord, ...]:
    """Return the coloured words of a file in order of their places, without overlaps.

    Words that came after the edition of the file are coloured as names, over what a grammar of an editor says of them.
    """
    names = {(o.span.line, o.span.column): o for o in analysis.index.by_path.get(path, ())}
    as_names = analysis.words_as_names(path)
    return tuple(
        structs.replace(word, kind="variable")
        if word.kind == "keyword" and (number, word.span.column) in as_names
        else word
        for number, line in enumerate(analysis.texts.get(path, "").split("\n"), 1)
        for word in _words(names, path, number, line)
    )


def _words(names: dict[tuple[int, int], Occurrence], path: str, number: int, line: str) -> Iterator[HighlightedWord]:
    for match in _TOKEN.finditer(line):
        start, end = match.start() + 1, match.end() + 1
        occurrence = names.get((number, start))
        group = match.lastgroup or ""
        if occurrence is not None:
            width = min(end, occurrence.span.end_column)
            yield HighlightedWord(
                Span(path, number, start, number, width), _kind(occurrence.symbol), occurrence.declares
            )
        elif group in _PLAIN:
            yield HighlightedWord(Span(path, number, start, number, end), _PLAIN[group])
        elif group == "name" and keyword_group(match.group()):
            yield HighlightedWord(Span(path, number, start, number, end), "keyword")


def _kind(symbol: Symbol) -> WordKind:
    match symbol:
        case TermSymbol(kind="class"):
            return "class"
        case TermSymbol(kind="relation"):
            return "method"
        case TermSymbol():
            return "property"
        case TypeSymbol():
            return "type"
        case FunctionSymbol() | SkillSymbol() | TaskSymbol():
            return "function"
        case ImplementationSymbol():
            return "interface"
        case ParameterSymbol():
            return "parameter"
        case _:
            return _kind_of_value(symbol)


def _kind_of_value(
    symbol: LocalSymbol
    | LabelSymbol
    | PrefixSymbol
    | IndividualSymbol
    | ChoiceSymbol
    | FailurePartSymbol
    | AggregateSymbol
    | QuantitySymbol
    | FileSymbol
    | SceneSymbol,
) -> WordKind:
    match symbol:
        case LocalSymbol() | IndividualSymbol():
            return "variable"
        case LabelSymbol():
            return "decorator"
        case PrefixSymbol():
            return "namespace"
        case ChoiceSymbol():
            return "enumMember"
        case FailurePartSymbol():
            return "property"
        case AggregateSymbol():
            return "function"
        case QuantitySymbol():
            return "number"
        case FileSymbol() | SceneSymbol():
            return "string"
        case _:
            assert_never(symbol)
