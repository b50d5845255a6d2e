"""The knowledge that remains after a write whose target may be the same as something known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from functools import lru_cache
from typing import assert_never

from msgspec import structs

from skillc_compiler.analysis.knowledge.alias_types import (
    AliasTypes,
    Pattern,
    Triple,
    any_individual,
    is_any_individual,
    same_individual,
)
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.changes import matches, may_become_true, may_become_untrue
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.readers import calls_python, relations_read, values_read
from skillc_compiler.analysis.knowledge.state import IndividualTerm, Side, State
from skillc_compiler.analysis.knowledge.writes import (
    OnceWrite,
    OutputWrite,
    PropertyWrite,
    RelationWrite,
    Write,
    canonical_relation,
    may_undo,
)
from skillc_model.conditions import (
    Adjust,
    Aggregate,
    And,
    Anything,
    Assign,
    Compare,
    Condition,
    Exists,
    Forall,
    ForEach,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.rewriting import substitute
from skillc_model.traversal import walk

ONE, OTHER = "|one", "|other"
"""Names of any individuals while it is found out what a write on the one changes for the other; no names begin so."""


def havoc(types: AliasTypes, state: State, writes: Iterable[Write]) -> State:
    """Return what is still known after any of these writes may have happened."""
    for write in writes:
        if state.done or state.unchanged:
            state = _havoc_each(types, state, write)
        match write:
            case RelationWrite() | PropertyWrite() if write.apart:
                state = _havoc_others(types, state, write)
            case RelationWrite():
                state = _havoc_relation(types, state, write)
            case PropertyWrite():
                state = _havoc_property(types, state, write)
            case OutputWrite(name=name):
                state = state.without_name(name).replace(assigned=state.assigned)
            case OnceWrite(key=key):
                state = state.replace(once_results={**state.once_results, key: None})
            case _:
                assert_never(write)
    return state


def _havoc_each(types: AliasTypes, state: State, write: Write) -> State:
    """Return the state without the effects on many that a write may undo, or may put on others than at the start."""
    return state.replace(
        done=frozenset(each for each in state.done if not _may_undo_each(types, state, write, each)),
        unchanged=frozenset(each for each in state.unchanged if not _may_shift(types, state, write, each)),
    )


def _may_undo_each(types: AliasTypes, state: State, write: Write, each: ForEach) -> bool:
    """Whether a write may undo an effect: not if it is on something that has not fulfilled the condition."""
    if not may_undo(types, write, each):
        return False
    subject = write.subject if isinstance(write, PropertyWrite) else Anything()
    if each not in state.unchanged or isinstance(subject, Anything) or is_any_individual(subject):
        return True
    return evaluate(types, state, substitute(each.when, {each.variable: subject})) is not False


def _may_shift(types: AliasTypes, state: State, write: Write, each: ForEach) -> bool:
    """Whether a write may change which individuals fulfil the condition of an effect on many, or what it makes them."""
    if any(_may_read(types, amount, write) for amount in _amounts(each)):
        return True
    types.classes[OTHER] = each.cls
    condition = canonical_condition(types, state, substitute(each.when, {each.variable: Variable(OTHER)}))
    if not _may_read(types, condition, write):
        return False
    known: dict[Condition, bool] = {fact: true for fact, true in state.facts.items() if isinstance(fact, Same | IsA)}
    return any(
        condition not in havoc(types, State({**known, condition: true}), (write,)).facts for true in (True, False)
    )


def _amounts(each: ForEach) -> Iterator[Condition]:
    """Yield conditions that read what the values of an effect are computed from."""
    match each.effect:
        case Adjust(low=low, high=high):
            yield from (Compare(end, "==", end) for end in (low, high) if end is not None)
        case Assign(value=value):
            yield Compare(value, "==", value)


def _may_read(types: AliasTypes, condition: Condition, write: Write) -> bool:
    """Whether a condition reads anything of what a write is on, or something computed."""
    relations, properties = relations_read(condition), {iri for _, iri in values_read(condition)}
    if _reads(types, condition, frozenset()) or any(map(types.is_computed, relations)):
        return True
    match write:
        case PropertyWrite(property=iri):
            return iri in properties
        case RelationWrite():
            name, _ = types.axioms.canonical.get(write.relation, (write.relation, False))
            return not relations.isdisjoint(types.axioms.affected.get(name, frozenset({name})))
    return False


def _havoc_others(types: AliasTypes, state: State, write: RelationWrite | PropertyWrite) -> State:
    """Return what is still known after a write on any individual that is none of those apart from it."""
    one, ends = Variable(ONE), ("subject", "object") if isinstance(write, RelationWrite) else ("subject",)
    named = {end: one for end in ends if is_any_individual(getattr(write, end))}
    types.classes[ONE] = next(types.class_of(getattr(write, end)) for end in named)
    known = state.with_facts({same_individual(one, each): False for each in write.apart})
    return havoc(types, known, (structs.replace(write, **named, apart=frozenset()),)).without_name(ONE)


def _havoc_relation(types: AliasTypes, state: State, write: RelationWrite) -> State:
    """Return the state without the facts that writing a relation may have made untrue."""
    fact = canonical_relation(types, state, write)
    kin = types.axioms.affected.get(fact[1], frozenset({fact[1]}))
    adds, takes = _patterns(types, fact, write.value)
    changed = (*adds, *takes)
    state = _havoc_computed(types, state, frozenset(touched.relation for touched in changed))
    lost = {
        fact
        for fact in _readers(types, state, kin.union(touched.relation for touched in changed))
        if (
            _is_affected(types, state, fact, state.facts[fact], adds, takes)
            if isinstance(fact, Holds)
            else _reads(types, fact, kin) and _depends_on(types, state, fact, changed)
        )
    }
    alone = {side: _add_possible(types, state, side, others, adds) for side, others in state.possible.items()}
    possible = {side: others for side, others in alone.items() if others is not None}
    return _without(state, lost, state.possible if possible == state.possible else possible)


def _patterns(types: AliasTypes, fact: Triple, value: bool | None) -> tuple[tuple[Pattern, ...], tuple[Pattern, ...]]:
    """Return the facts that writing a relation may make true, and those that it may make untrue."""
    known = types.patterns.get((fact, value))
    if known is None:
        adds = may_become_true(types, fact) if value is not False else ()
        known = types.patterns[fact, value] = adds, may_become_untrue(types, fact, value)
    return known


def _readers(types: AliasTypes, state: State, relations: Iterable[str]) -> Iterator[Condition]:
    """Yield the facts that may depend on any of these relations, some several times."""
    for relation in relations:
        yield from state.readers.of_relations.get(relation, ())
    yield from _readers_of_anything(types, state)


def _readers_of_anything(types: AliasTypes, state: State) -> Iterator[Condition]:
    """Yield the facts that may depend on any relation or property, some several times."""
    for iri, facts in state.readers.of_values.items():
        if _is_computed_value(types, iri):
            yield from facts
    yield from state.readers.by_python


def _without(state: State, lost: Set[Condition], possible: Mapping[Side, frozenset[IndividualTerm]]) -> State:
    """Return the state without some facts and with these possible values; the same object if nothing changes."""
    if not lost and possible is state.possible:
        return state
    facts = {fact: true for fact, true in state.facts.items() if fact not in lost} if lost else state.facts
    return state.replace(facts=facts, possible=possible)


def _is_affected(
    types: AliasTypes, state: State, fact: Holds, true: bool, adds: tuple[Pattern, ...], takes: tuple[Pattern, ...]
) -> bool:
    return any(matches(types, state, fact, pattern) for pattern in (takes if true else adds))


def _depends_on(types: AliasTypes, state: State, fact: Condition, changed: tuple[Pattern, ...]) -> bool:
    """Whether a condition that is more than one relation depends on what changes."""
    if _reads(types, fact, frozenset()):
        return True
    return any(matches(types, state, part, pattern) for part in _relations_in(fact) for pattern in changed)


def _add_possible(
    types: AliasTypes, state: State, side: Side, others: frozenset[IndividualTerm], adds: tuple[Pattern, ...]
) -> frozenset[IndividualTerm] | None:
    """Return the individuals that may be on the other side if these facts may be true too; None if any may."""
    relation, thing, is_subject = side
    for subject, above, object_, _ in adds:
        near, far = (subject, object_) if is_subject else (object_, subject)
        if above == relation and types.may_be_same(state, thing, near):
            if isinstance(far, Anything) or is_any_individual(far):
                return None
            others |= {far}
    return others


def _havoc_computed(types: AliasTypes, state: State, terms: frozenset[str]) -> State:
    """Return the state without the computed facts that depend on one of these relations and properties."""
    readers = state.readers.of_relations
    lost = {fact for relation in readers if types.depends_on(relation, terms) for fact in readers[relation]}
    alone = {side: others for side, others in state.possible.items() if not types.depends_on(side[0], terms)}
    return _without(state, lost, state.possible if len(alone) == len(state.possible) else alone)


def _havoc_property(types: AliasTypes, state: State, write: PropertyWrite) -> State:
    state = _havoc_computed(types, state, frozenset({write.property}))
    readers = (*state.readers.of_values.get(write.property, ()), *_readers_of_anything(types, state))
    lost = {
        fact
        for fact in readers
        if _reads_value(types, state, fact, write) and not _remains_known(types, state, fact, state.facts[fact], write)
    }
    return _without(state, lost, state.possible)


def _remains_known(types: AliasTypes, state: State, fact: Condition, true: bool, write: PropertyWrite) -> bool:
    """Whether a known fact about a value also holds after the write."""
    if isinstance(fact, HasProperty):
        return true and not write.cleared
    if not isinstance(fact, Compare) or not isinstance(fact.left, PropertyOf) or write.value is None:
        return False
    if not isinstance(fact.left.of, Variable | Individual) or fact.left.property != write.property:
        return False
    probe = Variable("?value")
    compared = Compare(probe, fact.operator, fact.right)
    value = State(facts={Compare(probe, "==", write.value): True})
    return evaluate(types, value, compared) is true


def _reads_value(types: AliasTypes, state: State, fact: Condition, write: PropertyWrite) -> bool:
    subject = substitute(write.subject, state.aliases)
    for of, iri in values_read(fact):
        if _is_computed_value(types, iri):
            return True
        if iri == write.property and (of is None or types.may_be_same(state, of, subject)):
            return True
    return calls_python(fact)


def _is_computed_value(types: AliasTypes, iri: str) -> bool:
    """Whether a value is computed, or may be."""
    term = types.vocabulary.properties.get(iri)
    return term is None or term.computed_by is not None


def _reads(types: AliasTypes, fact: Condition, relations: frozenset[str]) -> bool:
    """Whether a condition that is not a single relation depends on any of these relations."""
    if any(_is_computed_value(types, iri) for _, iri in values_read(fact)):
        return True
    return calls_python(fact) or not relations.isdisjoint(relations_read(fact))


@lru_cache(maxsize=16384)
def _relations_in(fact: Condition) -> tuple[Holds, ...]:
    """Return the relations that a condition reads; its own variables are any individuals of their classes."""
    if isinstance(fact, Holds):
        return (fact,)
    match fact:
        case Exists(variable=name, cls=cls, body=body) | Forall(variable=name, cls=cls, body=body):
            parts: tuple[Condition, ...] = (substitute(body, {name: any_individual(cls)}),)
        case Not(body=body):
            parts = (body,)
        case And(parts=parts) | Or(parts=parts):
            pass
        case _:
            inside = (each for each in walk(fact) if isinstance(each, Aggregate))
            parts = tuple(substitute(each.where, {each.variable: any_individual(each.cls)}) for each in inside)
    return tuple(found for part in parts for found in _relations_in(part))
