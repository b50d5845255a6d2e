"""Where a scene breaks the axioms of its vocabulary: each breach once, at the statement that came last."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from skillc_compiler.library.vocabulary import Position
from skillc_compiler.turtle.problems import Note, Place, Problem
from skillc_compiler.turtle.statements import Statement
from skillc_compiler.turtle.terms import RDF_TYPE
from skillc_runtime.scene.reading import Written
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.axiom_violations import Breach, Fact, broken, fault
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

RIVALS = frozenset({"functional-relation", "asymmetric-relation", "disjoint-classes"})
"""Axioms that two statements break together, neither more than the other."""


def breaches(state: WorldState, written: Sequence[Written]) -> Iterator[Problem]:
    """Yield a problem for each breach; `state` is the world after all that is written.

    Of statements that cannot be true together, one that is wrong by itself is told for that alone.
    """
    places = {fact: statement for change, statement in reversed(written) if (fact := _fact(change)) is not None}
    told: set[tuple[str, frozenset[Fact]]] = set()
    for change, statement in written:
        for breach in _broken(state, change):
            facts = _together(breach, _fact(change))
            if breach.axiom in RIVALS:
                if (breach.axiom, facts) in told or any(_is_wrong(state, each) for each in facts):
                    continue
                told.add((breach.axiom, facts))
            yield _problem(state, breach, statement, [places[fact] for fact in facts if fact in places], places)


def _broken(state: WorldState, change: Change) -> Iterator[Breach]:
    """Yield what is wrong with a change: where a rival took its place, rather what is wrong with it by itself."""
    for breach in broken(state, change):
        match change:
            case AddRelation(subject, relation, object_) if breach.axiom == "functional-relation":
                yield fault(state, (subject, relation, object_)) or breach
            case _:
                yield breach


def _is_wrong(state: WorldState, fact: Fact) -> bool:
    """Whether a fact is wrong by itself."""
    return fact[1] in state.vocabulary.relations and fault(state, fact) is not None


def _together(breach: Breach, own: Fact | None) -> frozenset[Fact]:
    """Return the facts that break the axiom together."""
    if own is None or own in breach.rivals or breach.axiom == "disjoint-classes":
        return frozenset(breach.rivals)
    return frozenset({own, *breach.rivals})


def _problem(
    state: WorldState, breach: Breach, own: Statement, together: Sequence[Statement], places: Mapping[Fact, Statement]
) -> Problem:
    if breach.axiom in RIVALS and together:
        first, *others = sorted((each.object_place for each in together), reverse=True)
    else:
        first, others = _place(breach, own), []
    notes = [Note(place, "said here too") for place in others]
    notes += (Note(places[fact].object_place, "its class") for fact in breach.causes if fact in places)
    return Problem(first, breach.axiom, breach.message, _help(breach), (*notes, *_declared(state, breach, own)))


def _place(breach: Breach, own: Statement) -> Place:
    """Return the term that is wrong: the predicate where it does not fit what it is said of, else the object."""
    subject_is_wrong = breach.misfit is not None and breach.misfit == iri_of(own.subject)
    return own.predicate_place if subject_is_wrong and breach.misfit != iri_of(own.object) else own.object_place


def _help(breach: Breach) -> str:
    return "keep one of them" if breach.axiom in RIVALS else ""


def _declared(state: WorldState, breach: Breach, own: Statement) -> Iterator[Note]:
    """Yield where the vocabulary says what a relation or property is about."""
    terms = state.vocabulary.relations.get(own.predicate) or state.vocabulary.properties.get(own.predicate)
    source: Position | None = terms.source if terms is not None and breach.causes else None
    if source is not None:
        yield Note(Place(source.path, source.line, source.column, source.line, source.column + 1), "declared here")


def _fact(change: Change) -> Fact | None:
    """Return the relation or class that a change writes."""
    match change:
        case AddIndividual(individual, (cls,)):
            return individual, RDF_TYPE, cls
        case AddRelation(subject, relation, object_):
            return subject, relation, object_
        case SetProperty(individual, property_, _):
            return individual, property_, ""
        case _:
            return None
