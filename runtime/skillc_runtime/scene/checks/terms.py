"""Checks the spelling of terms of RDF, RDFS and OWL."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.standard_terms import is_misspelt, standard_terms
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.suggestions import suggest


def check_spelling(said: Iterable[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield misspelt terms of RDF, RDFS and OWL."""
    for each in said:
        cls = iri_of(each.object) if each.predicate == RDF_TYPE else ""
        if is_misspelt(each.predicate):
            yield _misspelt("property", each.predicate, each.predicate_place, vocabulary)
        elif is_misspelt(cls):
            yield _misspelt("class", cls, each.object_place, vocabulary)


def _misspelt(kind: Literal["class", "property"], term: str, place: Span, vocabulary: Vocabulary) -> Diagnostic:
    near = suggest(term, place, vocabulary, standard_terms(term))
    return Diagnostic(f"unknown-{kind}", place, f"there is no {kind} {vocabulary.short(term)}", near.help, fix=near.fix)
