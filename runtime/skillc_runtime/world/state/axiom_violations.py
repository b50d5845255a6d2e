"""The axioms a version of the world must obey: what a write breaks is refused, with the axiom and the facts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TypeAlias, assert_never

from skillc_compiler.library.vocabulary import (
    THING,
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    ValueType,
    VectorType,
)
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.values import Value, finite, show
from skillc_runtime.world.state.vectors import is_direction, is_vector
from skillc_runtime.world.state.world_state import WorldState

Fact: TypeAlias = tuple[str, str, str]
"""A relation or a class as it was written: subject, predicate and object, all IRIs."""


@dataclass(frozen=True, slots=True)
class Breach:
    """An axiom that a change breaks, by name, and the axiom with the facts in words.

    `rivals` are facts that cannot be true beside the change, `causes` those that explain it. `misfit` is the
    individual that is of the wrong class, if that is what is wrong.
    """

    axiom: str
    message: str
    rivals: tuple[Fact, ...] = ()
    causes: tuple[Fact, ...] = ()
    misfit: str | None = None


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


def _misfit(state: WorldState, term: RelationTerm, subject: str, object_: str) -> Breach | None:
    """Say what a relation takes, when it takes neither signature's subject and object; None when one fits."""
    fits = (state.is_a(subject, each.domain) and state.is_a(object_, each.range) for each in term.signatures)
    if not term.signatures or any(fits):
        return None
    short = state.vocabulary.short
    accepted = " or ".join(f"({_class(state, each.domain)}, {_class(state, each.range)})" for each in term.signatures)
    wrong_subject = not any(state.is_a(subject, each.domain) for each in term.signatures)
    misfit = subject if wrong_subject else object_
    return Breach(
        "relation-domain" if wrong_subject else "relation-range",
        f"{short(term.iri)} takes {accepted}; {_described(state, subject)}, {_described(state, object_)}",
        causes=_types(state, misfit),
        misfit=misfit,
    )


def wrong_value(term: PropertyTerm, value: Value) -> str | None:
    """Say what a property takes when the value is none of it, None when it fits; several values are checked alone."""
    if not finite(value):
        return "NaN and infinity are no values"
    expected = _expected(term.type, value)
    if expected is not None:
        return f"it takes {expected}"
    if term.values and value not in term.values:
        return "it is one of " + ", ".join(term.values)
    if term.bounds is not None and isinstance(value, int | float) and not term.bounds.hold(value):
        return f"it is {term.bounds}"
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
        facts = tuple((individual, RDF_TYPE, cls) for cls in clash)
        yield Breach("disjoint-classes", f"{both}: the classes are disjoint", rivals=facts)


def _relation(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[Breach]:
    short = state.vocabulary.short
    fact = f"{short(subject)} {short(relation)} {short(object_)}"
    absent = [each for each in (subject, object_) if not state.exists(each)]
    if absent:
        yield Breach("unknown-individual", f"`{fact}`: there is no individual {short(absent[0])}")
        return
    if relation in state.axioms.computed:
        yield Breach("computed-property", f"`{fact}`: the relation is computed from other facts and cannot be stated")
        return
    if not state.holds(subject, relation, object_):
        reason, rivals = _rival(state, subject, relation, object_)
        yield Breach("functional-relation", f"`{fact}`: {reason}", rivals=rivals)
        return
    own = fault(state, (subject, relation, object_))
    opposite = list(_asymmetric(state, subject, relation, object_))[:1]
    yield from (own,) if own else (replace(breach, message=f"`{fact}`: {breach.message}") for breach in opposite)


def fault(state: WorldState, fact: Fact) -> Breach | None:
    """Return what is wrong with a relation between individuals by itself, whatever else is said."""
    short = state.vocabulary.short
    written = " ".join(map(short, fact))
    found = (breach for kind in (_irreflexive, _misfits) for breach in kind(state, *fact))
    return next((replace(breach, message=f"`{written}`: {breach.message}") for breach in found), None)


def _irreflexive(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[Breach]:
    for term, start, end in _implied(state, subject, relation, object_):
        if (term.irreflexive or term.asymmetric) and start == end:
            short, kind = state.vocabulary.short, "irreflexive" if term.irreflexive else "asymmetric"
            yield Breach("irreflexive-relation", f"{short(term.iri)} is {kind}, nothing has it to itself")


def _asymmetric(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[Breach]:
    for term, start, end in _implied(state, subject, relation, object_):
        if term.asymmetric and start != end and state.holds(end, term.iri, start):
            short = state.vocabulary.short
            opposite = f"{short(end)} {short(term.iri)} {short(start)}"
            rivals = _written(state, end, term.iri, start)
            yield Breach("asymmetric-relation", f"{short(term.iri)} is asymmetric, and `{opposite}` holds", rivals)


def _misfits(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[Breach]:
    for term, start, end in _implied(state, subject, relation, object_):
        breach = _misfit(state, term, start, end)
        if breach is not None:
            yield breach


def _implied(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[tuple[RelationTerm, str, str]]:
    """Yield what a fact implies, itself first: relations with their subjects and objects."""
    for implied, flipped in sorted(state.axioms.implied[relation], key=lambda each: each != (relation, False)):
        start, end = (object_, subject) if flipped else (subject, object_)
        yield state.vocabulary.relations[implied], start, end


def _written(state: WorldState, subject: str, relation: str, object_: str) -> tuple[Fact, ...]:
    """Return the facts, as they were written, from which one follows without transitivity."""
    found = (
        (source, object_, subject) if flipped else (source, subject, object_)
        for source, flipped in state.axioms.sources[relation]
    )
    return tuple((start, iri, end) for iri, start, end in found if end in state.asserted[iri].forward.get(start))


def _rival(state: WorldState, subject: str, relation: str, object_: str) -> tuple[str, tuple[Fact, ...]]:
    """Say which fact took the place of one that was written, and why both cannot be."""
    short = state.vocabulary.short
    for term, start, end in _implied(state, subject, relation, object_):
        if term.functional and (others := state.objects(start, term.iri) - {end}):
            rival = start, term.iri, min(others)
        elif term.inverse_functional and (others := state.subjects(term.iri, end) - {start}):
            rival = min(others), term.iri, end
        else:
            continue
        kind = "functional" if term.functional else "inverse functional"
        said = f"{short(rival[0])} {short(term.iri)} {short(rival[2])}"
        return f"{short(term.iri)} is {kind}, and `{said}` is said too", _written(state, *rival)
    return "the same write takes it back", ()


def _types(state: WorldState, individual: str) -> tuple[Fact, ...]:
    return tuple((individual, RDF_TYPE, cls) for cls in sorted(state.types(individual)))


def _property(state: WorldState, individual: str, property_: str, value: Value) -> Iterator[Breach]:
    short, term = state.vocabulary.short, state.vocabulary.properties[property_]
    fact = f"{short(individual)}.{short(property_)} = {show(value)}"
    if not state.exists(individual):
        yield Breach("unknown-individual", f"`{fact}`: there is no individual {short(individual)}")
        return
    if term.computed_by is not None:
        yield Breach("computed-property", f"`{fact}`: the property is computed from other facts and cannot be set")
    if term.domains and not any(state.is_a(individual, domain) for domain in term.domains):
        owners = " or ".join(_class(state, domain) for domain in term.domains)
        message = f"`{fact}`: it belongs to {owners}; {_described(state, individual)}"
        yield Breach("property-domain", message, causes=_types(state, individual), misfit=individual)
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
            return None if is_vector(value) else "a vector of three numbers"
        case DirectionType():
            return None if is_direction(value) else "a direction: a vector of length 1"
        case ClassType():
            return None if isinstance(value, str) else "an individual"
        case ListType():
            return None if isinstance(value, tuple) else "a list"
        case _:
            raise AssertionError(f"no such type: {type_}")
