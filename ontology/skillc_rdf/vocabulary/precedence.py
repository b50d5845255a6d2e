"""Which statements of a user's ontologies count beside the shipped ones.

What skillc ships about its terms stands: many copies of the same ontologies are about, some with axioms under which
nothing can exist. Others may put such a term below terms of their own, call one of their own equal or disjoint to it or
its inverse; whatever else they say of it is passed over.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.names import (
    BUILT_IN,
    DISJOINT,
    DOMAIN,
    EQUAL_CLASS,
    EQUAL_PROPERTY,
    INVERSE,
    OWL,
    RANGE,
    SUBCLASS,
    SUBPROPERTY,
    TYPE,
)
from skillc_rdf.vocabulary.reading import Ontology
from skillc_rdf.vocabulary.types import Vocabulary

LINKS = frozenset({SUBCLASS, SUBPROPERTY, DISJOINT, EQUAL_CLASS, EQUAL_PROPERTY, INVERSE})
"""What may be said of a shipped term and one of the user's."""
AXIOMS = LINKS | {DOMAIN, RANGE, f"{OWL}disjointUnionOf", f"{OWL}propertyChainAxiom", f"{OWL}hasKey"}
LISTED = 4


class Split(NamedTuple):
    """The statements of an ontology that count, and the shipped terms of which it says more than skillc does."""

    ontology: Ontology
    counting: tuple[ox.Quad, ...]
    passed: tuple[str, ...]


def split(ontology: Ontology, shipped: Iterable[Ontology], standing: frozenset[str]) -> Split:
    """Divide what an ontology says; `standing` are the terms that the shipped ones declare."""
    known = {(each.subject, each.predicate, each.object) for other in shipped for each in other.triples}
    counting: list[ox.Quad] = []
    passed: list[str] = []
    lists = _lists_of_shipped(ontology, standing)
    for each in ontology.triples:
        subject = each.subject.value if isinstance(each.subject, ox.NamedNode) else ""
        if isinstance(each.subject, ox.BlankNode) and each.subject in lists:
            passed += lists[each.subject] if each.predicate.value == TYPE else []
        elif subject not in standing or _links(each, standing):
            counting.append(each)
        elif _is_axiom(each) and (each.subject, each.predicate, each.object) not in known:
            passed.append(subject)
    return Split(ontology, tuple(counting), tuple(passed))


def passed_over(parts: Iterable[Split], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Tell, once for each file, what it says of shipped terms in vain."""
    for part in parts:
        if not part.passed:
            continue
        terms = sorted({f"`{vocabulary.short(iri)}`" for iri in part.passed})
        listed = ", ".join(terms[:LISTED]) + (f" and {len(terms) - LISTED} more" if terms[LISTED:] else "")
        count = f"{len(part.passed)} axiom{'s' * (len(part.passed) > 1)}"
        yield Diagnostic(
            "shipped-term",
            Span(part.ontology.source.path, 1, 1, 1, 2),
            f"{count} of this file about terms that skillc declares itself have no effect: {listed}",
            help="what skillc says of its terms stands; put terms of your own below them to say more",
            severity="warning",
        )


def _lists_of_shipped(ontology: Ontology, standing: frozenset[str]) -> dict[ox.BlankNode, list[str]]:
    """Return the axioms that say of shipped classes alone that they are disjoint, with the first of the classes."""
    graph = Graph(ontology.triples)
    found: dict[ox.BlankNode, list[str]] = {}
    for node in graph.nodes(f"{OWL}AllDisjointClasses"):
        members = [m for head in graph.objects(node, f"{OWL}members") for m in graph.members(head)]
        named = [each.value for each in members if isinstance(each, ox.NamedNode)]
        if isinstance(node, ox.BlankNode) and members and standing.issuperset(named):
            found[node] = named[:1]
    return found


def _links(triple: ox.Quad, standing: frozenset[str]) -> bool:
    """Whether a statement about a shipped term leads to one of the user's."""
    if triple.predicate.value not in LINKS or not isinstance(triple.object, ox.NamedNode):
        return False
    return triple.object.value not in standing and not triple.object.value.startswith(BUILT_IN)


def _is_axiom(triple: ox.Quad) -> bool:
    """Whether a statement would change what a term means."""
    if triple.predicate.value != TYPE:
        return triple.predicate.value in AXIOMS
    return isinstance(triple.object, ox.NamedNode) and triple.object.value.startswith(OWL)
