"""The axioms a version of the world must obey: what a write breaks is refused, with the axiom and the facts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import assert_never

import numpy as np

from skillc_compiler.library.vocabulary import (
    THING,
    ClassType,
    ListType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    ValueType,
    VectorType,
)
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value, finite, show


@dataclass(frozen=True, slots=True)
class Breach:
    """An axiom that a change breaks, by name, and the axiom with the facts in words."""

    axiom: str
    message: str


def broken(state: WorldState, change: Change) -> Iterator[Breach]:
    """Yield what is wrong with a change in the version it led to."""
    match change:
        case AddIndividual(individual, types):
            yield from _classes(state, individual, types)
        case AddRelation(subject, relation, object_):
            yield from _relation(state, subject, relation, object_)
        case SetProperty(individual, property_, value):
            yield from _property(state, individual, property_, value)
        case RemoveIndividual() | RemoveRelation() | ClearProperty():
            return
        case _:
            assert_never(change)


def unknown(state: WorldState, change: Change) -> str | None:
    """Return the IRI of a relation or property that the vocabulary lacks, None when all is known."""
    match change:
        case AddRelation(_, relation, _) | RemoveRelation(_, relation, _):
            return None if relation in state.vocabulary.relations else relation
        case SetProperty(_, property_, _) | ClearProperty(_, property_):
            return None if property_ in state.vocabulary.properties else property_
        case AddIndividual() | RemoveIndividual():
            return None
        case _:
            assert_never(change)


def _disjoint_classes(state: WorldState, types: Iterable[str]) -> tuple[str, str] | None:
    """Return two of the classes that no individual can both be of, None when there are none."""
    pairs = combinations(sorted(types), 2)
    return next(((one, other) for one, other in pairs if state.vocabulary.disjoint(one, other)), None)


def _misfit(state: WorldState, term: RelationTerm, subject: str, object_: str) -> str | None:
    """Say what a relation takes, when it takes neither signature's subject and object; None when one fits."""
    fits = (state.is_a(subject, each.domain) and state.is_a(object_, each.range) for each in term.signatures)
    if not term.signatures or any(fits):
        return None
    short = state.vocabulary.short
    accepted = " or ".join(f"({_class(state, each.domain)}, {_class(state, each.range)})" for each in term.signatures)
    return f"{short(term.iri)} takes {accepted}; {_described(state, subject)}, {_described(state, object_)}"


def wrong_value(term: PropertyTerm, value: Value) -> str | None:
    """Say what a property takes when the value is none of it, None when it fits; several values are checked alone."""
    if not finite(value):
        return "NaN and infinity are no values"
    expected = _expected(term.type, value)
    if expected is not None:
        return f"it takes {expected}"
    if term.values and value not in term.values:
        return "it is one of " + ", ".join(term.values)
    return None


def _classes(state: WorldState, individual: str, types: tuple[str, ...]) -> Iterator[Breach]:
    short = state.vocabulary.short
    for cls in types:
        if cls not in state.vocabulary.ancestors:
            yield Breach("unknown-class", f"{short(individual)} cannot be a {short(cls)}: there is no such class")
    clash = _disjoint_classes(state, state.types(individual))
    if clash:
        one, other = map(short, clash)
        both = f"{short(individual)} cannot be both a {one} and a {other}"
        yield Breach("disjoint-classes", f"{both}: the classes are disjoint")


def _relation(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[Breach]:
    short = state.vocabulary.short
    fact = f"{short(subject)} {short(relation)} {short(object_)}"
    absent = [each for each in (subject, object_) if each not in state.individuals]
    if absent:
        yield Breach("unknown-individual", f"`{fact}`: there is no individual {short(absent[0])}")
        return
    if not state.holds(subject, relation, object_):
        yield Breach("functional-relation", f"`{fact}`: {_rival(state, subject, relation, object_)}")
        return
    for implied, flipped in state.axioms.implied[relation]:
        term = state.vocabulary.relations[implied]
        start, end = (object_, subject) if flipped else (subject, object_)
        if term.irreflexive and start == end:
            yield Breach("irreflexive-relation", f"`{fact}`: {short(implied)} is irreflexive, nothing has it to itself")
        if term.asymmetric and state.holds(end, implied, start):
            opposite = f"{short(end)} {short(implied)} {short(start)}"
            yield Breach("asymmetric-relation", f"`{fact}`: {short(implied)} is asymmetric, and `{opposite}` holds")
        wrong = _misfit(state, term, start, end)
        if wrong:
            yield Breach("relation-range", f"`{fact}`: {wrong}")


def _rival(state: WorldState, subject: str, relation: str, object_: str) -> str:
    """Say which fact took the place of one that was written, and why both cannot be."""
    short = state.vocabulary.short
    for implied, flipped in state.axioms.implied[relation]:
        term = state.vocabulary.relations[implied]
        start, end = (object_, subject) if flipped else (subject, object_)
        if term.functional and (others := state.objects(start, implied) - {end}):
            fact = f"{short(start)} {short(implied)} {short(min(others))}"
            return f"{short(implied)} is functional, and `{fact}` is said too"
        if term.inverse_functional and (others := state.subjects(implied, end) - {start}):
            fact = f"{short(min(others))} {short(implied)} {short(end)}"
            return f"{short(implied)} is inverse functional, and `{fact}` is said too"
    return "the same write takes it back"


def _property(state: WorldState, individual: str, property_: str, value: Value) -> Iterator[Breach]:
    short, term = state.vocabulary.short, state.vocabulary.properties[property_]
    fact = f"{short(individual)}.{short(property_)} = {show(value)}"
    if individual not in state.individuals:
        yield Breach("unknown-individual", f"`{fact}`: there is no individual {short(individual)}")
        return
    if term.computed_by is not None:
        yield Breach("computed-property", f"`{fact}`: the property is computed from other facts and cannot be set")
    if term.domains and not any(state.is_a(individual, domain) for domain in term.domains):
        owners = " or ".join(_class(state, domain) for domain in term.domains)
        yield Breach("property-domain", f"`{fact}`: it belongs to {owners}; {_described(state, individual)}")
    several = not term.functional and isinstance(value, tuple)
    for one in value if several and isinstance(value, tuple) else (value,):
        wrong = wrong_value(term, one)
        if wrong:
            yield Breach("wrong-data-type", f"`{fact}`: {wrong}")


def _class(state: WorldState, iri: str) -> str:
    return "Thing" if iri == THING else state.vocabulary.short(iri)


def _described(state: WorldState, individual: str) -> str:
    short = state.vocabulary.short
    return f"{short(individual)} is a {' and a '.join(sorted(map(short, state.types(individual))))}"


def _expected(type_: ValueType, value: Value) -> str | None:
    """Return what a type takes when the value is not of it."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    match type_:
        case NumberType():
            return None if number else "a number"
        case PlainType("Bool"):
            return None if isinstance(value, bool) else "true or false"
        case PlainType("Int"):
            return None if number and isinstance(value, int | float) and value == int(value) else "a whole number"
        case PlainType("Text"):
            return None if isinstance(value, str) else "a text"
        case PlainType("Pose"):
            return None if isinstance(value, Pose) else "a pose"
        case VectorType():
            return None if _is_vector(value) else "a vector of three numbers"
        case ClassType():
            return None if isinstance(value, str) else "an individual"
        case ListType():
            return None if isinstance(value, tuple) else "a list"
        case _:
            raise AssertionError(f"no such type: {type_}")


def _is_vector(value: Value) -> bool:
    return isinstance(value, np.ndarray) and value.shape == (3,)
