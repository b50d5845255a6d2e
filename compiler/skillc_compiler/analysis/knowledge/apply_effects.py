"""What is known after certain writes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import assert_never

from msgspec import structs

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, is_any_individual
from skillc_compiler.analysis.knowledge.assume import single_values
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.denied import keep_denied
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.quantifiers import known_individuals, possible_witnesses
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.analysis.knowledge.writes import (
    OnceWrite,
    OutputWrite,
    PropertyWrite,
    RelationWrite,
    Write,
    canonical_relation,
    normalise_each,
    write_of,
    written_condition,
)
from skillc_model.conditions import (
    Anything,
    Compare,
    Condition,
    Effect,
    Exists,
    ForEach,
    HasProperty,
    Holds,
    Individual,
    PropertyOf,
    Retract,
    Variable,
    single_effect,
)
from skillc_model.rewriting import substitute


def apply_effects(types: AliasTypes, state: State, effects: Iterable[Effect], before: State | None = None) -> State:
    """Return the state after effects, retractions first, as the runtime applies them; of both, those on many first.

    What those on many are on is read in the state `before`, which is the same if there is none.
    """
    effects, before = tuple(effects), before or state
    writes = [(_order(effect, write), write) for effect in effects for write in _writes_of(types, before, effect)]
    for _, write in sorted(writes, key=lambda each: each[0]):
        state = apply_write(types, state, write)
    each = frozenset(normalise_each(effect) for effect in effects if isinstance(effect, ForEach)) & before.unchanged
    return state.replace(done=state.done | each) if each else state


def _writes_of(types: AliasTypes, before: State, effect: Effect) -> Iterator[Write]:
    """Yield the writes of an effect; of one on many individuals, also those on what certainly fulfils its condition."""
    if not isinstance(effect, ForEach):
        yield write_of(effect)
        return
    yield spare(types, before, write_of(effect))
    for thing in known_individuals(before):
        if is_member(types, before, effect, thing):
            yield write_of(substitute(effect.effect, {effect.variable: thing}))


def on_known_members(types: AliasTypes, before: State, effect: Effect) -> tuple[Effect, ...]:
    """Return an effect on many individuals as those on each, if it is known before which these are.

    Else it is itself, and what it is on those that are certainly among them. So is one that the skill promises as such.
    """
    if not isinstance(effect, ForEach):
        return (effect,)
    groups = () if normalise_each(effect) in before.unchanged else _groups_of(types, before, effect)
    for group in groups:
        members = {thing: is_member(types, before, effect, thing) for thing in group}
        if None not in members.values():
            return tuple(substitute(effect.effect, {effect.variable: each}) for each, true in members.items() if true)
    certain = (thing for thing in known_individuals(before) if is_member(types, before, effect, thing))
    return (effect, *(substitute(effect.effect, {effect.variable: each}) for each in certain))


def _groups_of(types: AliasTypes, before: State, effect: ForEach) -> Iterator[frozenset[IndividualTerm]]:
    when = canonical_condition(types, before, effect.when)
    return possible_witnesses(before, Exists(effect.variable, effect.cls, when))


def is_member(types: AliasTypes, before: State, effect: ForEach, thing: IndividualTerm) -> bool | None:
    """Whether an effect on many is on an individual; None if that is open."""
    fulfils = evaluate(types, before, substitute(effect.when, {effect.variable: thing}))
    return fulfils and types.is_a(before, thing, effect.cls)


def spare(types: AliasTypes, state: State, write: Write) -> Write:
    """Return a write on any individual that fulfils a condition as one apart from those that do not in this state."""
    if not isinstance(write, RelationWrite | PropertyWrite) or write.when is None:
        return write
    if isinstance(write, RelationWrite) and not types.axioms.chained.isdisjoint(_kin(types, write.relation)):
        return write
    every = write.subject if is_any_individual(write.subject) else getattr(write, "object", None)
    if not isinstance(every, Variable):
        return write
    apart = frozenset(
        thing
        for thing in known_individuals(state)
        if evaluate(types, state, substitute(write.when, {every.name: thing})) is False
    )
    return structs.replace(write, apart=apart)


def _kin(types: AliasTypes, relation: str) -> frozenset[str]:
    name, _ = types.axioms.canonical.get(relation, (relation, False))
    return types.axioms.affected.get(name, frozenset({name}))


def is_done(types: AliasTypes, state: State, effect: Effect) -> bool:
    """Whether what an effect makes so is known to be so already."""
    if isinstance(effect, ForEach):
        return normalise_each(effect) in state.done
    write = write_of(effect)
    condition = written_condition(write) if isinstance(write, RelationWrite | PropertyWrite) else None
    return condition is not None and bool(evaluate(types, state, condition))


def apply_write(types: AliasTypes, state: State, write: Write) -> State:
    """Return the state after a certain write."""
    after = _know_written(types, havoc(types, state, (write,)), write)
    return keep_denied(types, state, after, write)


def _know_written(types: AliasTypes, state: State, write: Write) -> State:
    match write:
        case RelationWrite(value=True):
            return _assert_relation(types, state, write)
        case RelationWrite(value=False):
            return _retract_relation(types, state, write)
        case PropertyWrite(subject=Variable() | Individual() as subject, property=iri, value=value):
            owner = state.aliases.get(subject.name, subject) if isinstance(subject, Variable) else subject
            facts: dict[Condition, bool] = {HasProperty(owner, iri): True}
            if value is not None:
                right = state.aliases.get(value.name, value) if isinstance(value, Variable) else value
                facts[Compare(PropertyOf(owner, iri), "==", right)] = True
            return state.with_facts(facts)
        case RelationWrite() | PropertyWrite() | OutputWrite() | OnceWrite():
            return state
        case _:
            assert_never(write)


def _order(effect: Effect, write: Write) -> tuple[bool, bool]:
    """Return when a write of an effect happens: what may be on any individual leaves open what is certain of one."""
    is_on_any = isinstance(effect, ForEach) and isinstance(write, RelationWrite | PropertyWrite) and write.value is None
    return not isinstance(single_effect(effect), Retract), not is_on_any


def _assert_relation(types: AliasTypes, state: State, write: RelationWrite) -> State:
    subject, relation, object_ = canonical_relation(types, state, write)
    if isinstance(subject, Anything) or isinstance(object_, Anything):
        return state
    axioms = types.axioms
    facts: dict[Condition, bool] = {}
    for above, turned in axioms.implied.get(relation, ((relation, False),)):
        facts[Holds(object_, above, subject) if turned else Holds(subject, above, object_)] = True
    return state.replace(facts={**state.facts, **facts}, possible={**state.possible, **single_values(axioms, facts)})


def _retract_relation(types: AliasTypes, state: State, write: RelationWrite) -> State:
    subject, relation, object_ = canonical_relation(types, state, write)
    facts: dict[Condition, bool] = {}
    alone = dict(state.possible)
    for source, turned in types.axioms.sources.get(relation, ((relation, False),)):
        if source in types.axioms.chained:
            continue
        start, end = (object_, subject) if turned else (subject, object_)
        if isinstance(start, Anything) or isinstance(end, Anything):
            thing, is_subject = (end, False) if isinstance(start, Anything) else (start, True)
            if not isinstance(thing, Anything):
                alone[(source, thing, is_subject)] = frozenset()
            continue
        facts[Holds(start, source, end)] = False
        for side, other in (((source, start, True), end), ((source, end, False), start)):
            if side in alone:
                alone[side] -= {other}
    return state.replace(facts={**state.facts, **facts}, possible=alone)
