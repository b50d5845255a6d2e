"""Checks the spelling of terms of RDF, RDFS and OWL, and that individuals are not blank nodes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import Node, Statement
from skillc_rdf.turtle.terms import RDF, RDF_TYPE
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.standard_terms import is_misspelt, standard_terms
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.suggestions import suggest

FIRST = f"{RDF}first"


def check_spelling(said: Iterable[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield misspelt terms of RDF, RDFS and OWL, and blank nodes that have a class of the vocabulary."""
    for each in said:
        cls = iri_of(each.object) if each.predicate == RDF_TYPE else ""
        if is_misspelt(each.predicate):
            yield _misspelt("property", each.predicate, each.predicate_place, vocabulary)
        elif is_misspelt(cls):
            yield _misspelt("class", cls, each.object_place, vocabulary)
        elif isinstance(each.subject, ox.BlankNode) and cls in vocabulary.classes:
            message = f"this {vocabulary.short(cls)} has no name"
            yield Diagnostic(
                "unnamed-individual", each.subject_place, message, f"write `:NAME a {vocabulary.short(cls)}`"
            )


def check_unnamed(said: Sequence[Statement], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a problem for each blank node without a class that has a relation or property, and for each list."""
    typed = {each.subject for each in said if each.predicate == RDF_TYPE and iri_of(each.object) in vocabulary.classes}
    lists = {each.subject for each in said if each.predicate == FIRST}
    reported = set[Node]()
    for each in said:
        relation = each.predicate in vocabulary.relations
        if relation and each.object in lists:
            message = f"{vocabulary.short(each.predicate)} leads to an individual, and this is a list"
            help_ = "name its members one after another, with a `,` between them"
            yield Diagnostic("relation-range", each.object_place, message, help_)
        for node, place in ((each.subject, each.subject_place), (each.object, each.object_place)):
            said_of = relation or (each.predicate in vocabulary.properties and node is each.subject)
            if said_of and isinstance(node, ox.BlankNode) and node not in typed | lists | reported:
                reported.add(node)
                yield Diagnostic(
                    "unnamed-individual", place, "this has no name", "give it one, and a class: `:NAME a CLASS`"
                )


def _misspelt(kind: Literal["class", "property"], term: str, place: Span, vocabulary: Vocabulary) -> Diagnostic:
    near = suggest(term, place, vocabulary, standard_terms(term))
    return Diagnostic(f"unknown-{kind}", place, f"there is no {kind} {vocabulary.short(term)}", near.help, fix=near.fix)
