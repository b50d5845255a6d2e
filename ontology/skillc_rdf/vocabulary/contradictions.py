"""Reports unsatisfiable classes, relations and properties, at the statements that make them so.

Considered are superclasses, disjoint classes, required values, domains, ranges, characteristics, inverses and
super-relations. The analysis is sound, not complete: an OWL reasoner may find more where several of these interact.
What is unsatisfiable only because something else is, is not reported.
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.conflicts import Conflict
from skillc_rdf.vocabulary.datatypes import describe_ranges
from skillc_rdf.vocabulary.expressions import find_needs, superclasses
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.iris import DISJOINT, DOMAIN, OWL, SUBCLASS, SUBPROPERTY, TYPE
from skillc_rdf.vocabulary.places import TermPositions
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_rdf.vocabulary.unsatisfiable import Reason, Unsatisfiable

NOTHING = f"{OWL}Nothing"


def report_contradictions(graph: Graph, vocabulary: Vocabulary, places: TermPositions) -> Iterator[Diagnostic]:
    """Report the classes, relations and properties that cannot be satisfied."""
    found = find_unsatisfiable(graph, vocabulary)
    for cls, reason in sorted(found.classes.items()):
        if not reason.follows:
            yield _class(vocabulary, cls, reason, places)
    for relation, reason in sorted(found.relations.items()):
        if not reason.follows:
            yield _relation(vocabulary, relation, reason, places)
    for cls in vocabulary.classes:
        if NOTHING in superclasses(graph, cls):
            reason = Reason("it is a subclass of `owl:Nothing`")
            yield _class(vocabulary, cls, reason, places)
    for property_ in vocabulary.properties:
        yield from _property(graph, vocabulary, property_, places)


def find_unsatisfiable(graph: Graph, vocabulary: Vocabulary) -> Unsatisfiable:
    """Return the classes of a vocabulary without possible members, and the relations that can never hold."""
    return Unsatisfiable(vocabulary, find_needs(graph, vocabulary))


def _class(vocabulary: Vocabulary, cls: str, reason: Reason, places: TermPositions) -> Diagnostic:
    message = f"nothing can be `{vocabulary.short(cls)}`: {reason.text}"
    place, labels = places.statement(cls, SUBCLASS), _disjointness(reason, places)
    return Conflict("impossible-class", place, message, _HELP_CLASS, labels=labels, term=cls)


def _relation(vocabulary: Vocabulary, relation: str, reason: Reason, places: TermPositions) -> Diagnostic:
    predicate = {"domain": DOMAIN, "parent": SUBPROPERTY, "kind": TYPE}[reason.kind]
    message = f"`{vocabulary.short(relation)}` can hold of nothing: {reason.text}"
    place, labels = places.statement(relation, predicate), _disjointness(reason, places)
    return Conflict("impossible-relation", place, message, _HELP_RELATION, labels=labels, term=relation)


def _disjointness(reason: Reason, places: TermPositions) -> tuple[Label, ...]:
    """Return the place where the classes of a reason are declared disjoint."""
    if reason.pair is None:
        return ()
    one, other = reason.pair
    stated = {places.statement(*each) for each in ((one, DISJOINT, other), (other, DISJOINT, one))}
    return (Label(min(stated), "these are disjoint"),)


def _property(graph: Graph, vocabulary: Vocabulary, iri: str, places: TermPositions) -> Iterator[Diagnostic]:
    types = describe_ranges(graph, iri)
    if len(types) > 1:
        both = " and ".join(types)
        message = f"`{vocabulary.short(iri)}` can have no value: each would have to be {both}"
        yield Conflict("impossible-relation", places.term(iri), message, "keep one of the ranges", term=iri)


_HELP_CLASS = "remove one of the superclasses, or correct their axioms"
_HELP_RELATION = "remove one of the conflicting axioms"
