"""Facts of a world as triples: all facts, and the triples that a transaction adds and removes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec
import pyoxigraph as ox

from skillc_rdf.turtle.terms import OWL, RDF_TYPE, RDFS
from skillc_rdf.vocabulary.types import NumberType, PropertyTerm, Vocabulary
from skillc_runtime.world.state.changes import named_individuals
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.vectors import format_vector, is_vector
from skillc_runtime.world.state.world_state import WorldState

TYPE, CLASS = ox.NamedNode(RDF_TYPE), ox.NamedNode(f"{OWL}Class")
SUBCLASS = ox.NamedNode(f"{RDFS}subClassOf")
PREFIX = ox.NamedNode("http://purl.org/vocab/vann/preferredNamespacePrefix")


class TripleDifference(msgspec.Struct, frozen=True):
    """The triples that differ between two versions of a world, sorted."""

    removed: tuple[ox.Triple, ...]
    added: tuple[ox.Triple, ...]


def triple_difference(event: ChangeEvent) -> TripleDifference:
    """Return the triples that a write adds and removes; StoreError for a fact that a triple cannot state.

    All facts that a change affects are about individuals that it names, so only these are compared.
    """
    if not event.before.individuals:
        declared = declarations(event.before.vocabulary, event.after.vocabulary)
        return TripleDifference((), tuple(sorted({*declared, *all_triples(event.after)}, key=str)))
    changed = frozenset(individual for change in event.changes for individual in named_individuals(change))
    before, after = set(_facts_about(changed, event.before)), set(_facts_about(changed, event.after))
    return TripleDifference(tuple(sorted(before - after, key=str)), tuple(sorted(after - before, key=str)))


def all_triples(state: WorldState) -> Iterator[ox.Triple]:
    """Yield the asserted facts about all individuals, in no particular order."""
    for individual in state.individuals:
        yield from _types(individual, state)
    for relation, links in state.asserted.items():
        yield from (_related(subject, relation, object_) for subject, object_ in links.pairs())
    for property_, table in state.stored.items():
        for individual, value in table.items():
            yield from _valued(individual, state.vocabulary.properties[property_], value)


def declarations(library: Vocabulary, own: Vocabulary) -> Iterator[ox.Triple]:
    """Yield the classes and prefixes that a vocabulary has in addition to those of a library."""
    for iri in own.classes.keys() - library.classes.keys():
        yield ox.Triple(_node(iri), TYPE, CLASS)
        yield from (ox.Triple(_node(iri), SUBCLASS, _node(parent)) for parent in own.classes[iri].parents)
    for prefix, base in own.prefixes.items() - library.prefixes.items():
        yield ox.Triple(_node(base), PREFIX, ox.Literal(prefix))


def _facts_about(individuals: Iterable[str], state: WorldState) -> Iterator[ox.Triple]:
    for individual in individuals:
        yield from _types(individual, state)
        for relation, links in state.asserted.items():
            yield from (_related(individual, relation, object_) for object_ in links.forward.get(individual))
            yield from (_related(subject, relation, individual) for subject in links.backward.get(individual))
        for property_, table in state.stored.items():
            yield from _valued(individual, state.vocabulary.properties[property_], table.get(individual))


def _types(individual: str, state: WorldState) -> Iterator[ox.Triple]:
    return (ox.Triple(_node(individual), TYPE, _node(cls)) for cls in state.types(individual))


def _related(subject: str, relation: str, object_: str) -> ox.Triple:
    return ox.Triple(_node(subject), _node(relation), _node(object_))


def _valued(individual: str, term: PropertyTerm, value: Value | None) -> Iterator[ox.Triple]:
    """Yield the values of a property; numbers are written as doubles."""
    for one in value if isinstance(value, tuple) else (value,):
        if isinstance(one, int) and isinstance(term.type, NumberType):
            yield ox.Triple(_node(individual), _node(term.iri), ox.Literal(float(one)))
        elif isinstance(one, bool | int | float | str):
            yield ox.Triple(_node(individual), _node(term.iri), ox.Literal(one))
        elif is_vector(one):
            yield ox.Triple(_node(individual), _node(term.iri), ox.Literal(format_vector(one)))
        elif one is not None:
            raise StoreError(
                f"a store cannot keep <{term.iri}> of <{individual}>: it is not a number, text or truth value"
            )


def _node(iri: str) -> ox.NamedNode:
    try:
        return ox.NamedNode(iri)
    except ValueError as error:
        raise StoreError(f"a store cannot keep `{iri}`: it is not an IRI") from error
