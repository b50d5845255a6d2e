"""Checks a whole world against its axioms, with one representative of all facts that an axiom treats alike."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import isfinite
from operator import itemgetter
from typing import TypeAlias, cast

from skillc_rdf.vocabulary.types import PropertyTerm
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.consistency.axiom_violations import asserted_facts, axiom_violations
from skillc_runtime.world.state.facts import IriTriple
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

_Entries: TypeAlias = list[tuple[str, Value]]


def satisfies_axioms(state: WorldState) -> bool:
    """Whether no fact violates an axiom; functional relations may have several values here, which violates theirs."""
    return not any(True for change in representatives(state) for _ in axiom_violations(state, change))


def representatives(state: WorldState) -> Iterator[Change]:
    """Yield changes that write facts of a version; if none of them violates an axiom, no fact of it does."""
    alike = {types: individual for individual, types in state.direct.items()}
    yield from (AddIndividual(individual, tuple(types)) for types, individual in alike.items())
    related = [fact for relation in state.asserted for fact in _one_per_kind(state, relation)]
    related += (fact for relation in state.facts for fact in _conflicting_facts(state, relation))
    yield from (AddRelation(*fact) for fact in related)
    for property_, table in state.stored.items():
        entries = [(individual, value) for individual, value in table.items() if value is not None]
        term = state.vocabulary.properties[property_]
        owners = {state.classes.get(individual): (individual, value) for individual, value in entries}
        yield from (SetProperty(one, property_, value) for one, value in (*owners.values(), *_extremes(entries, term)))


def _one_per_kind(state: WorldState, relation: str) -> Iterator[IriTriple]:
    """Yield one asserted fact for each combination of the classes of its subject and object."""
    of = state.classes.get
    kinds = {(of(start), of(end), start == end): (start, end) for start, end in state.asserted[relation].pairs()}
    yield from ((start, relation, end) for start, end in kinds.values())


def _conflicting_facts(state: WorldState, relation: str) -> Iterator[IriTriple]:
    """Yield the asserted facts that may exclude each other by the axioms of a relation."""
    term, facts = state.vocabulary.relations[relation], state.facts[relation]
    suspects: list[tuple[str, str]] = []
    if term.functional:
        suspects += ((one, each) for one, objects in facts.forward.items() if len(objects) > 1 for each in objects)
    if term.inverse_functional:
        suspects += ((each, one) for one, subjects in facts.backward.items() if len(subjects) > 1 for each in subjects)
    if term.asymmetric:
        suspects += ((start, end) for start, end in facts.pairs() if end in facts.backward.get(start))
    for start, end in suspects:
        yield from asserted_facts(state, start, relation, end)


def _extremes(entries: _Entries, term: PropertyTerm) -> _Entries:
    """Return entries with the values that can violate a bound: the least and greatest number, each listed text."""
    kinds = set(map(type, map(itemgetter(1), entries)))
    if kinds == {float} and isfinite(sum(map(cast("Callable[[object], float]", itemgetter(1)), entries))):
        return [min(entries, key=itemgetter(1)), max(entries, key=itemgetter(1))]
    if kinds == {str}:
        return list({value: (one, value) for one, value in entries}.values()) if term.values else entries[:1]
    return entries
