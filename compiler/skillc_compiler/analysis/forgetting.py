"""What is known no longer when something may have been written, because it may be the same."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import TypeAlias, assert_never

from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import Side, State, Thing
from skillc_compiler.analysis.truth import truth
from skillc_compiler.analysis.writes import Assigned, Ended, Related, Valued, Write, canonical
from skillc_model.conditions import (
    Anything,
    Compare,
    Condition,
    Exists,
    Forall,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.reading import walk
from skillc_model.rewriting import substitute


def forgotten(sorts: Sorts, state: State, writes: Iterable[Write]) -> State:
    """Return what is still known after any of these may have been written."""
    for write in writes:
        match write:
            case Related():
                state = _touched(sorts, state, write)
            case Valued():
                state = _without_value(sorts, state, write)
            case Assigned(name=name):
                state = state.without(name).replaced(assigned=state.assigned)
            case Ended(key=key):
                state = state.replaced(done={**state.done, key: None})
            case _:
                assert_never(write)
    return state


def _touched(sorts: Sorts, state: State, write: Related) -> State:
    """Take away every fact that the writing of a relation may have made untrue."""
    subject, relation, object_ = canonical(sorts, state, write)
    kin = sorts.axioms.kin.get(relation, frozenset({relation}))
    adds = _added(sorts, (subject, relation, object_)) if write.value is not False else ()
    takes = _taken(sorts, (subject, relation, object_), write.value)
    state = _uncomputed(sorts, state, frozenset(touched for _, touched, _ in (*adds, *takes)))
    facts = {
        fact: true
        for fact, true in state.facts.items()
        if not (_hit(sorts, state, fact, true, adds, takes) if isinstance(fact, Holds) else _reads(sorts, fact, kin))
    }
    alone = {side: _widened(sorts, state, side, others, adds) for side, others in state.alone.items()}
    return state.replaced(facts=facts, alone={side: others for side, others in alone.items() if others is not None})


Pattern: TypeAlias = tuple[Term, str, Term]


def _added(sorts: Sorts, fact: Pattern) -> tuple[Pattern, ...]:
    """Return the facts that an assertion may make true."""
    subject, relation, object_ = fact
    return tuple(
        _anywhere(sorts, (object_, above, subject) if turned else (subject, above, object_))
        for above, turned in sorts.axioms.implied.get(relation, ((relation, False),))
    )


def _taken(sorts: Sorts, fact: Pattern, value: bool | None) -> tuple[Pattern, ...]:
    """Return the facts that an assertion, by replacing others, or a retraction may make untrue."""
    axioms, (subject, relation, object_) = sorts.axioms, fact
    lost: list[Pattern] = []
    if value is not True:
        lost += [
            (object_, source, subject) if turned else (subject, source, object_)
            for source, turned in axioms.sources.get(relation, ((relation, False),))
        ]
    if value is not False:
        for start, above, end in _added(sorts, fact):
            for source, turned in axioms.sources.get(above, ((above, False),)):
                if above in axioms.single_object:
                    lost.append((Anything(), source, start) if turned else (start, source, Anything()))
                if above in axioms.single_subject:
                    lost.append((end, source, Anything()) if turned else (Anything(), source, end))
    return tuple(dict.fromkeys(pattern for each in lost for pattern in _added(sorts, each)))


def _anywhere(sorts: Sorts, pattern: Pattern) -> Pattern:
    """A relation that may hold by a chain of facts may change between any two individuals."""
    return (Anything(), pattern[1], Anything()) if pattern[1] in sorts.axioms.loose else pattern


def _hit(
    sorts: Sorts, state: State, fact: Holds, true: bool, adds: tuple[Pattern, ...], takes: tuple[Pattern, ...]
) -> bool:
    return any(_matches(sorts, state, fact, pattern) for pattern in (takes if true else adds))


def _matches(sorts: Sorts, state: State, fact: Holds, pattern: Pattern) -> bool:
    subject, relation, object_ = pattern
    return (
        fact.relation == relation
        and _may_be(sorts, state, fact.subject, subject)
        and _may_be(sorts, state, fact.object, object_)
    )


def _may_be(sorts: Sorts, state: State, one: Term, other: Term) -> bool:
    if isinstance(one, Anything) or isinstance(other, Anything):
        return True
    return not sorts.differ(state, one, other)


def _widened(
    sorts: Sorts, state: State, side: Side, others: frozenset[Thing], adds: tuple[Pattern, ...]
) -> frozenset[Thing] | None:
    """Return who may be on the other side when these facts may be true too; None for anybody."""
    relation, thing, is_subject = side
    for subject, above, object_ in adds:
        near, far = (subject, object_) if is_subject else (object_, subject)
        if above == relation and _may_be(sorts, state, thing, near):
            if isinstance(far, Anything) or (isinstance(far, Variable) and far.name.startswith("?")):
                return None
            others |= {far}
    return others


def _uncomputed(sorts: Sorts, state: State, terms: frozenset[str]) -> State:
    """Take away what is known by computations that one of these relations and properties may decide."""
    facts = {
        fact: true
        for fact, true in state.facts.items()
        if not any(sorts.is_decided_by(relation, terms) for relation in _relations_read(fact))
    }
    alone = {side: others for side, others in state.alone.items() if not sorts.is_decided_by(side[0], terms)}
    same = len(facts) == len(state.facts) and len(alone) == len(state.alone)
    return state if same else state.replaced(facts=facts, alone=alone)


def _without_value(sorts: Sorts, state: State, write: Valued) -> State:
    state = _uncomputed(sorts, state, frozenset({write.property}))
    facts = {
        fact: true
        for fact, true in state.facts.items()
        if not _reads_value(sorts, state, fact, write) or _agrees(sorts, state, fact, true, write)
    }
    return state if len(facts) == len(state.facts) else state.replaced(facts=facts)


def _agrees(sorts: Sorts, state: State, fact: Condition, true: bool, write: Valued) -> bool:
    """Whether what is known of a value is so after the write too."""
    if isinstance(fact, HasProperty):
        return true and not write.cleared
    if not isinstance(fact, Compare) or not isinstance(fact.left, PropertyOf) or write.value is None:
        return False
    if not isinstance(fact.left.of, Variable | Individual) or fact.left.property != write.property:
        return False
    probe = Variable("?value")
    compared = Compare(probe, fact.operator, fact.right)
    value = State(facts={Compare(probe, "==", write.value): True})
    return truth(sorts, value, compared) is true


def _reads_value(sorts: Sorts, state: State, fact: Condition, write: Valued) -> bool:
    subject = substitute(write.subject, state.same)
    for of, iri in _values_read(fact):
        term = sorts.vocabulary.properties.get(iri)
        if term is None or term.computed_by is not None:
            return True
        if iri == write.property and (of is None or _may_be(sorts, state, of, subject)):
            return True
    return _reads_all(fact)


def _reads(sorts: Sorts, fact: Condition, relations: frozenset[str]) -> bool:
    """Whether a condition that is no single relation depends on any of these."""
    computed = (sorts.vocabulary.properties.get(iri) for _, iri in _values_read(fact))
    if any(term is None or term.computed_by is not None for term in computed):
        return True
    return _reads_all(fact) or not relations.isdisjoint(_relations_read(fact))


@lru_cache(maxsize=4096)
def _values_read(fact: Condition) -> tuple[tuple[Thing | None, str], ...]:
    bound = {each.variable for each in walk(fact) if isinstance(each, Exists | Forall)}
    found: list[tuple[Thing | None, str]] = []
    for each in walk(fact):
        match each:
            case HasProperty(subject=of, property=iri) | PropertyOf(of=of, property=iri):
                plain = isinstance(of, Individual) or (isinstance(of, Variable) and of.name not in bound)
                found.append((of if plain and isinstance(of, Variable | Individual) else None, iri))
    return tuple(found)


@lru_cache(maxsize=4096)
def _relations_read(fact: Condition) -> frozenset[str]:
    return frozenset(each.relation for each in walk(fact) if isinstance(each, Holds))


@lru_cache(maxsize=4096)
def _reads_all(fact: Condition) -> bool:
    """Whether a condition calls Python, which may read anything."""
    return not isinstance(fact, Same | IsA) and any(isinstance(each, Invoke) for each in walk(fact))
