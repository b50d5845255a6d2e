"""The declarations and references of a symbol."""

from __future__ import annotations

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.symbols import (
    FileSymbol,
    Occurrence,
    Symbol,
    TermSymbol,
)
from skillc_dsl.source import Span


def find_symbols(analysis: Analysis, path: str, line: int, column: int) -> tuple[Occurrence, ...]:
    """Return the occurrences of the name under the cursor; two if it is an argument that is short for `name: name`."""
    there = analysis.index.at(path, line, column)
    return tuple(occurrence for occurrence in there if occurrence.span == there[0].span)


def find_declarations(analysis: Analysis, symbol: Symbol) -> tuple[Span, ...]:
    """Return the declarations of a symbol; several for a relation with several signatures."""
    match symbol:
        case FileSymbol(path=path):
            return (Span(path, 1, 1, 1, 1),)
        case _:
            written = tuple(occurrence.span for occurrence in analysis.index.declarations(symbol))
            outside = _outside(analysis, symbol)
            return (*outside, *written) if outside else written


def _outside(analysis: Analysis, symbol: Symbol) -> tuple[Span, ...]:
    """Return the declaration of a term in the ontology; empty for other symbols, which the index holds."""
    match symbol:
        case TermSymbol(iri=iri):
            base = analysis.library.vocabulary
            term = base.classes.get(iri) or base.relations.get(iri) or base.properties.get(iri)
            place = term.source if term else None
            return (Span(place.path, place.line, place.column, place.line, place.column),) if place else ()
        case _:
            return ()


def find_references(analysis: Analysis, path: str, line: int, column: int, declarations: bool) -> tuple[Span, ...]:
    """Return all references to the name under the cursor, with its declarations if `declarations` is true."""
    symbols = {occurrence.symbol for occurrence in find_symbols(analysis, path, line, column)}
    places = (o for symbol in symbols for o in analysis.index.of(symbol) if declarations or not o.declares)
    return tuple(sorted({occurrence.span for occurrence in places}))
