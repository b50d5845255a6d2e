"""The knowledge that remains after a write whose target may be the same as something known."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import NamedTuple, TypeAlias, assert_never

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, any_individual, is_any_individual
from skillc_compiler.analysis.knowledge.evaluate import evaluate
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
    And,
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
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.rewriting import substitute
from skillc_model.traversal import walk


def havoc(types: AliasTypes, state: State, writes: Iterable[Write]) -> State:
    """Return what is still known after any of these writes may have happened."""
    for write in writes:
        if state.done:
            state = state.replace(done=frozenset(each for each in state.done if not may_undo(types, write, each)))
        match write:
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


def _havoc_relation(types: AliasTypes, state: State, write: RelationWrite) -> State:
    """Return the state without the facts that writing a relation may have made untrue."""
    subject, relation, object_ = canonical_relation(types, state, write)
    kin = types.axioms.affected.get(relation, frozenset({relation}))
    adds = _may_become_true(types, (subject, relation, object_)) if write.value is not False else ()
    takes = _may_become_untrue(types, (subject, relation, object_), write.value)
    changed = (*adds, *takes)
    state = _havoc_computed(types, state, frozenset(touched.relation for touched in changed))
    facts = {
        fact: true
        for fact, true in state.facts.items()
        if not (
            _is_affected(types, state, fact, true, adds, takes)
            if isinstance(fact, Holds)
            else _reads(types, fact, kin) and _depends_on(types, state, fact, changed)
        )
    }
    alone = {side: _add_possible(types, state, side, others, adds) for side, others in state.possible.items()}
    return state.replace(facts=facts, possible={side: others for side, others in alone.items() if others is not None})


Triple: TypeAlias = tuple[Term, str, Term]


class Pattern(NamedTuple):
    """Facts that may change: those of a relation between two terms, or, of a link, all by a chain in which it is."""

    subject: Term
    relation: str
    object: Term
    is_link: bool = False


def _may_become_true(types: AliasTypes, fact: Triple) -> tuple[Pattern, ...]:
    """Return the facts that an assertion may make true."""
    subject, relation, object_ = fact
    return tuple(
        _in_chains(types, Pattern(*((object_, above, subject) if turned else (subject, above, object_))))
        for above, turned in types.axioms.implied.get(relation, ((relation, False),))
    )


def _may_become_untrue(types: AliasTypes, fact: Triple, value: bool | None) -> tuple[Pattern, ...]:
    """Return the facts that an assertion, by replacing others, or a retraction may make untrue."""
    subject, relation, object_ = fact
    lost: list[Triple] = []
    if value is not True:
        lost += [
            (object_, source, subject) if turned else (subject, source, object_)
            for source, turned in types.axioms.sources.get(relation, ((relation, False),))
        ]
    if value is not False:
        lost += [each for true in _may_become_true(types, fact) for each in _replaced_by(types, true)]
    return tuple(dict.fromkeys(pattern for each in lost for pattern in _may_become_true(types, each)))


def _replaced_by(types: AliasTypes, fact: Pattern) -> Iterator[Triple]:
    """Yield the facts that end when this one begins, as its relation has one object or one subject."""
    axioms, relation = types.axioms, fact.relation
    subject, object_ = (Anything(), Anything()) if fact.is_link else (fact.subject, fact.object)
    for source, turned in axioms.sources.get(relation, ((relation, False),)):
        if relation in axioms.single_object:
            yield (Anything(), source, subject) if turned else (subject, source, Anything())
        if relation in axioms.single_subject:
            yield (object_, source, Anything()) if turned else (Anything(), source, object_)


def _in_chains(types: AliasTypes, pattern: Pattern) -> Pattern:
    """Return the pattern; if the relation may hold by a chain of facts, of those in which this one is a link.

    Of a relation that is not transitive itself, but above one that is, any fact may change.
    """
    if pattern.relation not in types.axioms.chained:
        return pattern
    if pattern.relation in types.axioms.transitive:
        return pattern._replace(is_link=True)
    return Pattern(Anything(), pattern.relation, Anything())


def _is_affected(
    types: AliasTypes, state: State, fact: Holds, true: bool, adds: tuple[Pattern, ...], takes: tuple[Pattern, ...]
) -> bool:
    return any(_matches(types, state, fact, pattern) for pattern in (takes if true else adds))


def _depends_on(types: AliasTypes, state: State, fact: Condition, changed: tuple[Pattern, ...]) -> bool:
    """Whether a condition that is more than one relation depends on what changes."""
    if _reads(types, fact, frozenset()):
        return True
    return any(_matches(types, state, part, pattern) for part in _relations_in(fact) for pattern in changed)


def _matches(types: AliasTypes, state: State, fact: Holds, pattern: Pattern) -> bool:
    if fact.relation != pattern.relation:
        return False
    if pattern.is_link:
        return _may_lead_over(types, state, fact, pattern)
    return types.may_be_same(state, fact.subject, pattern.subject) and types.may_be_same(
        state, fact.object, pattern.object
    )


def _may_lead_over(types: AliasTypes, state: State, fact: Holds, link: Pattern) -> bool:
    """Whether a chain from the subject of a fact to its object may lead over a link.

    It gets to where the link begins, and from where it ends to the object. If no chain leads back to where it begins,
    none leads over a link that ends at its subject or begins at its object.
    """
    if link.relation in types.axioms.acyclic and (
        _is_one(fact.subject, link.object) or _is_one(fact.object, link.subject)
    ):
        return False
    return _may_lead_to(types, state, fact.subject, link.relation, link.subject) and _may_lead_to(
        types, state, link.object, link.relation, fact.object
    )


def _may_lead_to(types: AliasTypes, state: State, start: Term, relation: str, end: Term) -> bool:
    """Whether two terms may be the same, or a chain of a relation may lead from one to the other."""
    return types.may_be_same(state, start, end) or state.facts.get(Holds(start, relation, end)) is not False


def _is_one(one: Term, other: Term) -> bool:
    """Whether two terms are certainly the same individual."""
    return one == other and not isinstance(one, Anything) and not is_any_individual(one)


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
    facts = {
        fact: true
        for fact, true in state.facts.items()
        if not any(types.depends_on(relation, terms) for relation in _relations_read(fact))
    }
    alone = {side: others for side, others in state.possible.items() if not types.depends_on(side[0], terms)}
    same = len(facts) == len(state.facts) and len(alone) == len(state.possible)
    return state if same else state.replace(facts=facts, possible=alone)


def _havoc_property(types: AliasTypes, state: State, write: PropertyWrite) -> State:
    state = _havoc_computed(types, state, frozenset({write.property}))
    facts = {
        fact: true
        for fact, true in state.facts.items()
        if not _reads_value(types, state, fact, write) or _remains_known(types, state, fact, true, write)
    }
    return state if len(facts) == len(state.facts) else state.replace(facts=facts)


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
    for of, iri in _values_read(fact):
        term = types.vocabulary.properties.get(iri)
        if term is None or term.computed_by is not None:
            return True
        if iri == write.property and (of is None or types.may_be_same(state, of, subject)):
            return True
    return _calls_python(fact)


def _reads(types: AliasTypes, fact: Condition, relations: frozenset[str]) -> bool:
    """Whether a condition that is not a single relation depends on any of these relations."""
    computed = (types.vocabulary.properties.get(iri) for _, iri in _values_read(fact))
    if any(term is None or term.computed_by is not None for term in computed):
        return True
    return _calls_python(fact) or not relations.isdisjoint(_relations_read(fact))


@lru_cache(maxsize=4096)
def _values_read(fact: Condition) -> tuple[tuple[IndividualTerm | None, str], ...]:
    bound = {each.variable for each in walk(fact) if isinstance(each, Exists | Forall)}
    found: list[tuple[IndividualTerm | None, str]] = []
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
            parts = ()
    return tuple(found for part in parts for found in _relations_in(part))


@lru_cache(maxsize=4096)
def _calls_python(fact: Condition) -> bool:
    """Whether a condition calls Python, which may read anything."""
    return not isinstance(fact, Same | IsA) and any(isinstance(each, Invoke) for each in walk(fact))
