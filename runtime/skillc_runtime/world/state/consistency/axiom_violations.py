"""The axioms that a version of the world must satisfy, and the violations that a change causes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, combinations
from typing import assert_never

import msgspec
from msgspec.structs import replace

from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import THING, RelationTerm
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.consistency.value_types import value_error
from skillc_runtime.world.state.facts import IriTriple
from skillc_runtime.world.state.values import Value, show
from skillc_runtime.world.state.world_state import WorldState

CONTAINMENT_CIRCLE = "containment-circle"


class AxiomViolation(msgspec.Struct, frozen=True):
    """A violated axiom, by name, with a message that states the axiom and the facts.

    `conflicting` are facts that cannot be true together with the change; `causes` are facts that explain the violation.
    `mistyped` is the individual of the wrong class, if a class is wrong.
    """

    axiom: str
    message: str
    conflicting: tuple[IriTriple, ...] = ()
    causes: tuple[IriTriple, ...] = ()
    mistyped: str | None = None


def axiom_violations(state: WorldState, change: Change) -> Iterator[AxiomViolation]:
    """Yield the axioms that a change violates; `state` is the version after the change."""
    match change:
        case AddIndividual(individual, types):
            yield from _class_violations(state, individual, types)
        case AddRelation(subject, relation, object_):
            yield from _relation_violations(state, subject, relation, object_)
        case SetProperty(individual, property_, value):
            yield from _property_violations(state, individual, property_, value)
        case RemoveIndividual() | RemoveRelation() | ClearProperty():
            return
        case _:
            assert_never(change)


def unknown_term(state: WorldState, change: Change) -> str | None:
    """Return the IRI of a relation or property that the vocabulary lacks; None when it has all of them."""
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
    """Return two of the classes that are disjoint; None when no two are."""
    pairs = combinations(sorted(types), 2)
    return next(((one, other) for one, other in pairs if state.vocabulary.disjoint(one, other)), None)


def _signature_violation(state: WorldState, term: RelationTerm, subject: str, object_: str) -> AxiomViolation | None:
    """Return the violation of a relation's signatures; None when one of them fits."""
    fits = (state.is_a(subject, each.domain) and state.is_a(object_, each.range) for each in term.signatures)
    if not term.signatures or any(fits):
        return None
    short = state.vocabulary.short
    accepted = " or ".join(
        f"({_class_name(state, each.domain)}, {_class_name(state, each.range)})" for each in term.signatures
    )
    wrong_subject = not any(state.is_a(subject, each.domain) for each in term.signatures)
    mistyped = subject if wrong_subject else object_
    return AxiomViolation(
        "relation-domain" if wrong_subject else "relation-range",
        f"{short(term.iri)} takes {accepted}; {_describe_types(state, subject)}, {_describe_types(state, object_)}",
        causes=_types(state, mistyped),
        mistyped=mistyped,
    )


def _class_violations(state: WorldState, individual: str, types: tuple[str, ...]) -> Iterator[AxiomViolation]:
    short = state.vocabulary.short
    for cls in types:
        if cls not in state.vocabulary.ancestors:
            message = f"{short(individual)} cannot be a {short(cls)}: there is no such class"
            yield AxiomViolation("unknown-class", message)
    clash = _disjoint_classes(state, state.types(individual))
    if clash:
        one, other = map(short, clash)
        both = f"{short(individual)} cannot be both a {one} and a {other}"
        facts = tuple((individual, RDF_TYPE, cls) for cls in clash)
        yield AxiomViolation("disjoint-classes", f"{both}: the classes are disjoint", conflicting=facts)


def _relation_violations(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[AxiomViolation]:
    fact, short = (subject, relation, object_), state.vocabulary.short
    absent = [each for each in (subject, object_) if not state.exists(each)]
    if absent:
        yield AxiomViolation(
            "unknown-individual", f"{_format_fact(state, fact)}: there is no individual {short(absent[0])}"
        )
        return
    if relation in state.axioms.computed:
        reason = "the relation is computed from other facts and cannot be stated"
        yield AxiomViolation("computed-property", f"{_format_fact(state, fact)}: {reason}")
        return
    conflict = _functional_conflict(state, fact)
    if conflict is not None:
        reason, rivals = conflict
        yield AxiomViolation("functional-relation", f"{_format_fact(state, fact)}: {reason}", conflicting=rivals)
        return
    violation = standalone_violation(state, fact) or _with_fact(
        state, fact, next(_asymmetry_violations(state, *fact), None)
    )
    if violation is not None:
        yield violation


def standalone_violation(state: WorldState, fact: IriTriple) -> AxiomViolation | None:
    """Return the axiom that a relation between two individuals violates, whatever other facts there are."""
    return _with_fact(
        state, fact, next(chain(_irreflexivity_violations(state, *fact), _signature_violations(state, *fact)), None)
    )


def _irreflexivity_violations(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[AxiomViolation]:
    for term, start, end in _implied(state, subject, relation, object_):
        if (term.irreflexive or term.asymmetric) and start == end:
            short, kind = state.vocabulary.short, "irreflexive" if term.irreflexive else "asymmetric"
            yield AxiomViolation("irreflexive-relation", f"{short(term.iri)} is {kind}, nothing has it to itself")


def _asymmetry_violations(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[AxiomViolation]:
    for term, start, end in _implied(state, subject, relation, object_):
        if (term.asymmetric or term.is_acyclic) and start != end and state.holds(end, term.iri, start):
            short = state.vocabulary.short
            opposite = f"{short(end)} {short(term.iri)} {short(start)}"
            axiom, kind = ("asymmetric-relation", "asymmetric") if term.asymmetric else (CONTAINMENT_CIRCLE, "acyclic")
            rivals = asserted_facts(state, end, term.iri, start)
            yield AxiomViolation(axiom, f"{short(term.iri)} is {kind}, and `{opposite}` holds", rivals)


def _signature_violations(state: WorldState, subject: str, relation: str, object_: str) -> Iterator[AxiomViolation]:
    for term, start, end in _implied(state, subject, relation, object_):
        violation = _signature_violation(state, term, start, end)
        if violation is not None:
            yield violation


def _implied(state: WorldState, subject: str, relation: str, object_: str) -> Sequence[tuple[RelationTerm, str, str]]:
    """Return the relations that a fact implies, with their subjects and objects; the fact itself first."""
    links = tuple(state.vocabulary.implied_links(relation, subject, object_))
    if len(links) < 2:
        return links
    return sorted(links, key=lambda each: each[0].iri != relation or each[1] != subject)


def asserted_facts(state: WorldState, subject: str, relation: str, object_: str) -> tuple[IriTriple, ...]:
    """Return the asserted facts from which a fact follows without transitivity."""
    found = (
        (source, object_, subject) if flipped else (source, subject, object_)
        for source, flipped in state.axioms.sources[relation]
    )
    return tuple((start, iri, end) for iri, start, end in found if end in state.asserted[iri].forward.get(start))


def _functional_conflict(state: WorldState, fact: IriTriple) -> tuple[str, tuple[IriTriple, ...]] | None:
    """Return the reason and the asserted facts that a functional relation does not allow together with a fact, or None.

    A fact that was written and does not hold was replaced by another one of the same write.
    """
    short, holds = state.vocabulary.short, state.holds(*fact)
    for term, start, end in _implied(state, *fact):
        others = state.objects(start, term.iri) - {end} if term.functional else frozenset[str]()
        holders = state.subjects(term.iri, end) - {start} if term.inverse_functional else frozenset[str]()
        rivals = [(start, term.iri, other) for other in sorted(others)] or [
            (holder, term.iri, end) for holder in sorted(holders)
        ]
        for rival in rivals[: None if holds else 1]:
            written = asserted_facts(state, *rival)
            if written or not holds:
                kind, stated = "functional" if term.functional else "inverse functional", " ".join(map(short, rival))
                return f"{short(term.iri)} is {kind}, and `{stated}` is stated too", written
    return None if holds else ("the same write replaces it", ())


def _with_fact(state: WorldState, fact: IriTriple, violation: AxiomViolation | None) -> AxiomViolation | None:
    """Return a violation whose message begins with the written fact."""
    return violation and replace(violation, message=f"{_format_fact(state, fact)}: {violation.message}")


def _format_fact(state: WorldState, fact: IriTriple) -> str:
    return f"`{' '.join(map(state.vocabulary.short, fact))}`"


def _types(state: WorldState, individual: str) -> tuple[IriTriple, ...]:
    return tuple((individual, RDF_TYPE, cls) for cls in sorted(state.types(individual)))


def _property_violations(state: WorldState, individual: str, property_: str, value: Value) -> Iterator[AxiomViolation]:
    short, term = state.vocabulary.short, state.vocabulary.properties[property_]

    def stating(reason: str) -> str:
        return f"`{short(individual)}.{short(property_)} = {show(value)}`: {reason}"

    if not state.exists(individual):
        yield AxiomViolation("unknown-individual", stating(f"there is no individual {short(individual)}"))
        return
    if term.computed_by is not None:
        reason = "the property is computed from other facts and cannot be set"
        yield AxiomViolation("computed-property", stating(reason))
    if term.domains and not any(state.is_a(individual, domain) for domain in term.domains):
        owners = " or ".join(_class_name(state, domain) for domain in term.domains)
        message = stating(f"it belongs to {owners}; {_describe_types(state, individual)}")
        yield AxiomViolation("property-domain", message, causes=_types(state, individual), mistyped=individual)
    for one in value if isinstance(value, tuple) and not term.functional else (value,):
        wrong = value_error(term, one)
        if wrong:
            yield AxiomViolation("wrong-data-type", stating(wrong))


def _class_name(state: WorldState, iri: str) -> str:
    return "Thing" if iri == THING else state.vocabulary.short(iri)


def _describe_types(state: WorldState, individual: str) -> str:
    short = state.vocabulary.short
    return f"{short(individual)} is a {' and a '.join(sorted(map(short, state.types(individual))))}"
