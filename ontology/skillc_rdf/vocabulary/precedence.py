"""Selects the statements of a user's ontologies that take effect beside the shipped ones.

The shipped axioms about shipped terms are final, because many copies of the same ontologies exist, some with axioms
that make their classes unsatisfiable. Users may put a shipped term below a term of their own, or declare one of their
own equivalent, disjoint or inverse to it; other statements about shipped terms are ignored.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import (
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
"""The predicates that users may state between a shipped term and one of their own."""
AXIOMS = LINKS | {DOMAIN, RANGE, f"{OWL}disjointUnionOf", f"{OWL}propertyChainAxiom", f"{OWL}hasKey"}
LISTED = 4


class Split(NamedTuple):
    """The statements of an ontology that take effect, and the shipped terms of those that are ignored."""

    ontology: Ontology
    counting: tuple[ox.Triple, ...]
    passed: tuple[str, ...]


def split_statements(ontology: Ontology, shipped: Iterable[Ontology], standing: frozenset[str]) -> Split:
    """Divide the statements of an ontology; `standing` are the shipped terms."""
    known = {(each.subject, each.predicate, each.object) for other in shipped for each in other.triples}
    counting: list[ox.Triple] = []
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


def report_ignored(parts: Iterable[Split], vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Report, once per file, the ignored axioms about shipped terms."""
    for part in parts:
        if not part.passed:
            continue
        terms = sorted({f"`{vocabulary.short(iri)}`" for iri in part.passed})
        listed = ", ".join(terms[:LISTED]) + (f" and {len(terms) - LISTED} more" if terms[LISTED:] else "")
        count = f"{len(part.passed)} axiom{'s' * (len(part.passed) > 1)}"
        yield Diagnostic(
            "shipped-term",
            Span(part.ontology.source.path, 1, 1, 1, 2),
            f"{count} of this file about shipped terms have no effect: {listed}",
            help="shipped terms cannot be changed; declare terms of your own below them",
            severity="warning",
        )


def _lists_of_shipped(ontology: Ontology, standing: frozenset[str]) -> dict[ox.BlankNode, list[str]]:
    """Return the axioms that declare only shipped classes disjoint, with the first of the classes."""
    graph = Graph(ontology.triples)
    found: dict[ox.BlankNode, list[str]] = {}
    for node in graph.nodes(f"{OWL}AllDisjointClasses"):
        members = [m for head in graph.objects(node, f"{OWL}members") for m in graph.members(head)]
        named = [each.value for each in members if isinstance(each, ox.NamedNode)]
        if isinstance(node, ox.BlankNode) and members and standing.issuperset(named):
            found[node] = named[:1]
    return found


def _links(triple: ox.Triple, standing: frozenset[str]) -> bool:
    """Whether a statement about a shipped term links it to one of the user's."""
    if triple.predicate.value not in LINKS or not isinstance(triple.object, ox.NamedNode):
        return False
    return triple.object.value not in standing and not triple.object.value.startswith(BUILT_IN)


def _is_axiom(triple: ox.Triple) -> bool:
    """Whether a statement is an axiom rather than an annotation."""
    if triple.predicate.value != TYPE:
        return triple.predicate.value in AXIOMS
    return isinstance(triple.object, ox.NamedNode) and triple.object.value.startswith(OWL)
