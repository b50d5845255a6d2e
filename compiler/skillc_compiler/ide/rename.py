"""Renames a symbol in all files, or explains why it cannot be renamed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from itertools import groupby

import msgspec

from skillc_compiler.ide.analysis import Analysis, analyse
from skillc_compiler.ide.places import find_symbols
from skillc_compiler.ide.symbols import (
    FunctionSymbol,
    ImplementationSymbol,
    LabelSymbol,
    LocalSymbol,
    Occurrence,
    ParameterSymbol,
    SkillSymbol,
    Symbol,
    TaskSymbol,
    TermSymbol,
)
from skillc_compiler.resolve.files import Parser
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source, Span
from skillc_dsl.token_table import KEYWORDS, NAME, NAMES_ELSEWHERE

_RENAMED = (
    *(TermSymbol, FunctionSymbol, SkillSymbol, ImplementationSymbol),
    *(TaskSymbol, ParameterSymbol, LocalSymbol, LabelSymbol),
)


class Renaming(msgspec.Struct, frozen=True):
    """The edits that rename a symbol; `span` is the place of the old name under the cursor."""

    span: Span
    edits: tuple[Fix, ...]


class NotRenamable(msgspec.Struct, frozen=True):
    """The reason why a symbol cannot be renamed."""

    reason: str


def find_renamable(analysis: Analysis, path: str, line: int, column: int) -> Span | NotRenamable:
    """Return the place of the name under the cursor if it can be renamed."""
    found = _at(analysis, path, line, column)
    return found if isinstance(found, NotRenamable) else _name_in(analysis, found.span)


def rename(
    analysis: Analysis, path: str, line: int, column: int, new: str, parsed_by: Parser = parse
) -> Renaming | NotRenamable:
    """Return the edits in all files that rename the symbol under the cursor to `new`.

    A symbol that is declared outside the library, an invalid name, and a name that would cause an error are refused.
    """
    found = _at(analysis, path, line, column)
    if isinstance(found, NotRenamable):
        return found
    if not re.fullmatch(NAME, new) or new in _reserved():
        return NotRenamable(
            f"`{new}` is no name: a name is letters, digits and `_`, begins with a letter and is no keyword"
        )
    edits = tuple(dict.fromkeys(_edits(analysis, found.symbol, new)))
    broken = _broken(analysis, edits, parsed_by)
    return NotRenamable(f"`{new}` would not do: {broken.message}") if broken else Renaming(found.span, edits)


def _reserved() -> frozenset[str]:
    return frozenset(word for words in KEYWORDS.values() for word in words) - NAMES_ELSEWHERE


def _at(analysis: Analysis, path: str, line: int, column: int) -> Occurrence | NotRenamable:
    """Return the occurrence to rename; for a shorthand argument that of the local name."""
    there = find_symbols(analysis, path, line, column)
    if not there or not isinstance(there[0].symbol, _RENAMED):
        return NotRenamable("there is nothing here that has a name of its own")
    chosen = there[-1]
    if isinstance(chosen.symbol, TermSymbol) and chosen.symbol.iri in _ontology(analysis):
        return NotRenamable(f"`{_text(analysis, chosen.span)}` is declared in the ontology, which other files rely on")
    if isinstance(chosen.symbol, TermSymbol) and (task := _populating(analysis, chosen.symbol.iri)):
        return NotRenamable(
            f"the scene of the task `{task}` has a `{_text(analysis, chosen.span)}`: rename it there first"
        )
    places = [occurrence.span for occurrence in analysis.index.declarations(chosen.symbol)]
    if not places:
        return NotRenamable(f"the declaration of `{_text(analysis, chosen.span)}` is not known")
    elsewhere = [place.path for place in places if place.path not in analysis.library.sources]
    if elsewhere:
        return NotRenamable(f"`{_text(analysis, chosen.span)}` is declared in {elsewhere[0]}, outside of this library")
    return chosen


def _populating(analysis: Analysis, cls: str) -> str | None:
    """Return the name of a task whose scene has an individual of this class, if any."""
    scenes = analysis.library.scenes.items()
    return next((task for task, found in scenes if any(cls in classes for classes in found.values())), None)


def _ontology(analysis: Analysis) -> frozenset[str]:
    base = analysis.library.vocabulary
    return frozenset((*base.classes, *base.relations, *base.properties))


def _edits(analysis: Analysis, symbol: Symbol, new: str) -> Iterator[Fix]:
    for occurrence in analysis.index.of(symbol):
        span = _name_in(analysis, occurrence.span)
        old = _text(analysis, span)
        text = new
        if occurrence.shorthand:
            text = f"{new}: {old}" if _is_parameter_of_call(analysis, occurrence) else f"{old}: {new}"
        yield Fix(span, text, "rename")


def _is_parameter_of_call(analysis: Analysis, occurrence: Occurrence) -> bool:
    """Whether an occurrence in a shorthand argument, listed first, is that of the called skill's parameter."""
    there = find_symbols(analysis, occurrence.span.path, occurrence.span.line, occurrence.span.column)
    halves = [other for other in there if other.span == occurrence.span]
    return halves[0].symbol == occurrence.symbol


def _name_in(analysis: Analysis, span: Span) -> Span:
    """Return the place of a name without its prefix."""
    prefix, colon, _ = _text(analysis, span).rpartition(":")
    return span._replace(column=span.column + len(prefix) + len(colon))


def _text(analysis: Analysis, span: Span) -> str:
    return analysis.text_of(span)


def _broken(analysis: Analysis, edits: Iterable[Fix], parsed_by: Parser) -> Diagnostic | None:
    """Return the first error that the edits would cause, if any."""
    library = analysis.library
    sources = {**library.sources, **_edited(library.sources, edits)}
    after = analyse(replace(library, sources=sources), parsed_by)
    before = [problem.name for problem in analysis.problems if problem.severity == "error"]
    for problem in after.problems:
        if problem.severity == "error" and problem.name not in before:
            return problem
    return None


def _edited(sources: Mapping[str, Source], edits: Iterable[Fix]) -> dict[str, Source]:
    ordered = sorted(edits, key=lambda edit: edit.span.path)
    grouped = groupby(ordered, key=lambda edit: edit.span.path)
    return {path: sources[path]._replace(text=apply_fixes(sources[path].text, group)) for path, group in grouped}
