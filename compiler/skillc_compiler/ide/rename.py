"""Renames a symbol in all files of a project, or explains why it cannot be renamed."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.iri_edits import IriChange, refuse_iri, rename_iri
from skillc_compiler.ide.project_names import ProjectNames
from skillc_compiler.ide.symbols import (
    ChoiceSymbol,
    FunctionSymbol,
    ImplementationSymbol,
    IndividualSymbol,
    LabelSymbol,
    LocalSymbol,
    Occurrence,
    ParameterSymbol,
    SkillSymbol,
    Symbol,
    TaskSymbol,
    TermSymbol,
)
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Span
from skillc_dsl.token_table import KEYWORDS, NAME, NAMES_ELSEWHERE

_RENAMED = (
    *(TermSymbol, FunctionSymbol, SkillSymbol, ImplementationSymbol, IndividualSymbol),
    *(TaskSymbol, ParameterSymbol, LocalSymbol, LabelSymbol, ChoiceSymbol),
)
_INDIVIDUAL = rf"{NAME}(?:-+\w+)*"
Judge = Callable[[tuple[Fix, ...]], Iterable[Diagnostic]]
"""Returns the problems of the project after edits."""


class Renaming(msgspec.Struct, frozen=True):
    """The edits that rename a symbol; `span` is the place of the old name under the cursor."""

    span: Span
    edits: tuple[Fix, ...]


class NotRenamable(msgspec.Struct, frozen=True):
    """The reason why a symbol cannot be renamed."""

    reason: str


def find_renamable(names: ProjectNames, path: str, line: int, column: int) -> Span | NotRenamable:
    """Return the place of the name under the cursor if it can be renamed."""
    found = _at(names, path, line, column)
    return found if isinstance(found, NotRenamable) else _name_in(names, found)


def rename(
    names: ProjectNames, path: str, line: int, column: int, new: str, problems: Iterable[Diagnostic], judge: Judge
) -> Renaming | NotRenamable:
    """Return the edits in all files that rename the symbol under the cursor to `new`.

    A symbol that is declared outside the project, an invalid name, a name that is taken, and one after which the
    project has more errors than the `problems` before are refused.
    """
    found = _at(names, path, line, column)
    if isinstance(found, NotRenamable):
        return found
    refused = _refuse_name(found.symbol, new)
    if refused is not None:
        return NotRenamable(refused)
    change = rename_iri(names, found.symbol, new)
    refused = None if change is None else refuse_iri(names, change)
    if refused is not None:
        return NotRenamable(refused)
    edits = tuple(dict.fromkeys(_edits(names, found.symbol, new, change)))
    broken = _broken(problems, judge(edits))
    return NotRenamable(f"`{new}` would not do: {broken.message}") if broken else Renaming(found.span, edits)


def _refuse_name(symbol: Symbol, new: str) -> str | None:
    if isinstance(symbol, IndividualSymbol):
        rule = "letters, digits, `_` and `-`, and begins with a letter"
        return None if re.fullmatch(_INDIVIDUAL, new) else f"`{new}` is no name: the name of an individual is {rule}"
    if re.fullmatch(NAME, new) and new not in _reserved():
        return None
    return f"`{new}` is no name: a name is letters, digits and `_`, begins with a letter and is no keyword"


def _reserved() -> frozenset[str]:
    return frozenset(word for words in KEYWORDS.values() for word in words) - NAMES_ELSEWHERE


def _at(names: ProjectNames, path: str, line: int, column: int) -> Occurrence | NotRenamable:
    """Return the occurrence to rename; for a shorthand argument that of the local name."""
    there, analysis = names.at(path, line, column), names.analysis
    symbol = there[-1].symbol if there else None
    if not isinstance(symbol, _RENAMED) or (isinstance(symbol, ChoiceSymbol) and not symbol.iri):
        return NotRenamable("there is nothing here that has a name of its own")
    chosen = there[-1]
    written = _text(names, _name_in(names, chosen))
    outside = _declared_outside(names, chosen.symbol)
    if outside is not None:
        return NotRenamable(f"`{written}` is declared in {outside}")
    places = [occurrence.span for occurrence in names.declarations(chosen.symbol)]
    if not places and isinstance(symbol, IndividualSymbol):
        return NotRenamable(f"no scene of the project states the class of `{written}`")
    if not places:
        return NotRenamable(f"the declaration of `{written}` is not known")
    elsewhere = [each.path for each in places if each.path not in {**analysis.library.sources, **names.turtle}]
    if elsewhere:
        return NotRenamable(f"`{written}` is declared in {elsewhere[0]}, outside of this library")
    return chosen


def _declared_outside(names: ProjectNames, symbol: Symbol) -> str | None:
    """Return which ontology declares a term, if it is not one of the project's texts in Turtle."""
    base = names.analysis.library.vocabulary
    if not isinstance(symbol, TermSymbol):
        return None
    term = base.classes.get(symbol.iri) or base.relations.get(symbol.iri) or base.properties.get(symbol.iri)
    if term is None or (term.source is not None and term.source.path in names.turtle):
        return None
    return "the ontology, which other files rely on"


def _edits(names: ProjectNames, symbol: Symbol, new: str, change: IriChange | None) -> Iterator[Fix]:
    for occurrence in names.of(symbol):
        if occurrence.span.path in names.turtle:
            continue
        span = _name_in(names, occurrence)
        old = _text(names, span)
        text = new
        if occurrence.shorthand:
            text = f"{new}: {old}" if _is_parameter_of_call(names.analysis, occurrence) else f"{old}: {new}"
        yield Fix(span, text, "rename")
    yield from () if change is None else change.edits(names)


def _is_parameter_of_call(analysis: Analysis, occurrence: Occurrence) -> bool:
    """Whether an occurrence in a shorthand argument, listed first, is that of the called skill's parameter."""
    there = analysis.index.at(occurrence.span.path, occurrence.span.line, occurrence.span.column)
    halves = [other for other in there if other.span == occurrence.span]
    return halves[0].symbol == occurrence.symbol


def _name_in(names: ProjectNames, occurrence: Occurrence) -> Span:
    """Return the place of a name without its prefix; of a value of an enumeration also without that of its class."""
    span, symbol = occurrence.span, occurrence.symbol
    text = _text(names, span)
    if isinstance(symbol, ChoiceSymbol) and text.endswith(symbol.text):
        return span._replace(column=span.end_column - len(symbol.text))
    inside = text.removesuffix(">")
    local = re.split(r"[:#/]", inside)[-1]
    end = span.end_column - (len(text) - len(inside))
    return span._replace(column=end - len(local), end_column=end)


def _text(names: ProjectNames, span: Span) -> str:
    """Return the text at a place in one line."""
    line = names.texts.get(span.path, "").split("\n")[span.line - 1]
    return line[span.column - 1 : span.end_column - 1]


def _broken(before: Iterable[Diagnostic], after: Iterable[Diagnostic]) -> Diagnostic | None:
    """Return the first error of a kind of which there are more than before, if any."""
    known = Counter(each.name for each in before if each.severity == "error")
    errors = [each for each in after if each.severity == "error"]
    more = Counter(each.name for each in errors) - known
    return next((each for each in errors if each.name in more), None)
