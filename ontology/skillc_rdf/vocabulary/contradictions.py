"""Reports unsatisfiable classes, relations and properties, at the statements that make them so.

Considered are superclasses, disjoint classes, required values, domains, ranges, characteristics, inverses and
super-relations. The analysis is sound, not complete: an OWL reasoner may find more where several of these interact.
What is unsatisfiable only because something else is, is not reported.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.datatypes import describe_ranges
from skillc_rdf.vocabulary.expressions import RequiredValue, required_values, superclasses
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
    names: dict[str, list[str]] = {iri: [iri] for iri in vocabulary.classes}
    for alias, term in vocabulary.aliases.items():
        if term in names:
            names[term].append(alias)
    needs = ((iri, _needs(graph, vocabulary, same)) for iri, same in names.items())
    return Unsatisfiable(vocabulary, {iri: found for iri, found in needs if found})


def _needs(graph: Graph, vocabulary: Vocabulary, names: Sequence[str]) -> tuple[RequiredValue, ...]:
    """Return the values that each member of a class must have, stated under any of its names."""
    named = vocabulary.aliases.get
    return tuple(
        RequiredValue(named(need.property, need.property), need.least, named(need.filler or "", need.filler))
        for name in names
        for need in required_values(graph, name)
    )


def _class(vocabulary: Vocabulary, cls: str, reason: Reason, places: TermPositions) -> Diagnostic:
    labels: tuple[Label, ...] = ()
    if reason.pair is not None:
        one, other = reason.pair
        stated = {places.statement(*each) for each in ((one, DISJOINT, other), (other, DISJOINT, one))}
        labels = tuple(Label(span, "these are disjoint") for span in sorted(stated)[:1])
    message = f"nothing can be `{vocabulary.short(cls)}`: {reason.text}"
    return Diagnostic("impossible-class", places.statement(cls, SUBCLASS), message, _HELP_CLASS, labels=labels)


def _relation(vocabulary: Vocabulary, relation: str, reason: Reason, places: TermPositions) -> Diagnostic:
    predicate = {"domain": DOMAIN, "parent": SUBPROPERTY, "kind": TYPE}[reason.kind]
    message = f"`{vocabulary.short(relation)}` can hold of nothing: {reason.text}"
    return Diagnostic("impossible-relation", places.statement(relation, predicate), message, _HELP_RELATION)


def _property(graph: Graph, vocabulary: Vocabulary, iri: str, places: TermPositions) -> Iterator[Diagnostic]:
    types = describe_ranges(graph, iri)
    if len(types) > 1:
        both = " and ".join(types)
        message = f"`{vocabulary.short(iri)}` can have no value: each would have to be {both}"
        yield Diagnostic("impossible-relation", places.term(iri), message, "keep one of the ranges")


_HELP_CLASS = "remove one of the superclasses, or correct their axioms"
_HELP_RELATION = "remove one of the conflicting axioms"
