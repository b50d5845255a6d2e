"""Tells of classes that nothing can be and of relations that hold of nothing, at the statement that makes them so.

Followed are superclasses, disjoint classes, what members need to have, domains, ranges, characteristics, inverses and
super-relations. All that is told is so; a reasoner for OWL may find more where several of these meet, as where a thing
that is needed needs the first one back and can have one only. What is impossible only by something else that is told is
not told again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_rdf.vocabulary.datatypes import ranges_of
from skillc_rdf.vocabulary.expressions import Needed, needs, superclasses
from skillc_rdf.vocabulary.graph import Graph
from skillc_rdf.vocabulary.impossible import Impossible, Reason
from skillc_rdf.vocabulary.names import DISJOINT, DOMAIN, OWL, SUBCLASS, SUBPROPERTY, TYPE
from skillc_rdf.vocabulary.places import Places
from skillc_rdf.vocabulary.types import Vocabulary

NOTHING = f"{OWL}Nothing"


def contradictions(graph: Graph, vocabulary: Vocabulary, places: Places) -> Iterator[Diagnostic]:
    """Yield what cannot be."""
    found = impossible(graph, vocabulary)
    for cls, reason in sorted(found.classes.items()):
        if not reason.follows:
            yield _class(vocabulary, cls, reason, places)
    for relation, reason in sorted(found.relations.items()):
        if not reason.follows:
            yield _relation(vocabulary, relation, reason, places)
    for cls in vocabulary.classes:
        if NOTHING in superclasses(graph, cls):
            reason = Reason("it is said to be below `owl:Nothing`")
            yield _class(vocabulary, cls, reason, places)
    for property_ in vocabulary.properties:
        yield from _property(graph, vocabulary, property_, places)


def impossible(graph: Graph, vocabulary: Vocabulary) -> Impossible:
    """Return all classes and relations of a vocabulary that can have no member or hold of nothing."""
    names: dict[str, list[str]] = {iri: [iri] for iri in vocabulary.classes}
    for alias, term in vocabulary.aliases.items():
        if term in names:
            names[term].append(alias)
    return Impossible(vocabulary, {iri: _needs(graph, vocabulary, same) for iri, same in names.items()})


def _needs(graph: Graph, vocabulary: Vocabulary, names: Sequence[str]) -> tuple[Needed, ...]:
    """Return what each member of a class has by its own declarations, under any of its names."""
    named = vocabulary.aliases.get
    return tuple(
        Needed(named(need.property, need.property), need.least, named(need.filler or "", need.filler))
        for name in names
        for need in needs(graph, name)
    )


def _class(vocabulary: Vocabulary, cls: str, reason: Reason, places: Places) -> Diagnostic:
    labels: tuple[Label, ...] = ()
    if reason.pair is not None:
        one, other = reason.pair
        stated = {places.statement(*each) for each in ((one, DISJOINT, other), (other, DISJOINT, one))}
        labels = tuple(Label(span, "these have nothing in common") for span in sorted(stated)[:1])
    message = f"nothing can be `{vocabulary.short(cls)}`: {reason.text}"
    return Diagnostic("impossible-class", places.statement(cls, SUBCLASS), message, _HELP_CLASS, labels=labels)


def _relation(vocabulary: Vocabulary, relation: str, reason: Reason, places: Places) -> Diagnostic:
    predicate = {"domain": DOMAIN, "parent": SUBPROPERTY, "kind": TYPE}[reason.kind]
    message = f"`{vocabulary.short(relation)}` can hold of nothing: {reason.text}"
    return Diagnostic("impossible-relation", places.statement(relation, predicate), message, _HELP_RELATION)


def _property(graph: Graph, vocabulary: Vocabulary, iri: str, places: Places) -> Iterator[Diagnostic]:
    types = ranges_of(graph, iri)
    if len(types) > 1:
        both = " and ".join(types)
        message = f"`{vocabulary.short(iri)}` can have no value: its values are to be {both} at once"
        yield Diagnostic("impossible-relation", places.term(iri), message, "keep one of the ranges")


_HELP_CLASS = "take the class from below one of them, or mend what is said of them"
_HELP_RELATION = "take away what does not go together"
