"""What is known after certain writes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.assume import single_values
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import (
    OnceWrite,
    OutputWrite,
    PropertyWrite,
    RelationWrite,
    Write,
    canonical_relation,
    normalise_each,
    write_of,
)
from skillc_model.conditions import (
    Anything,
    Compare,
    Condition,
    Effect,
    ForEach,
    HasProperty,
    Holds,
    Individual,
    PropertyOf,
    Variable,
)


def apply_effects(types: AliasTypes, state: State, effects: Iterable[Effect]) -> State:
    """Return the state after effects, retractions first, as the runtime applies them."""
    effects = tuple(effects)
    writes = sorted((write_of(effect) for effect in effects), key=lambda w: not _is_retraction(w))
    for write in writes:
        state = apply_write(types, state, write)
    each = frozenset(normalise_each(effect) for effect in effects if isinstance(effect, ForEach))
    return state.replace(done=state.done | each) if each else state


def apply_write(types: AliasTypes, state: State, write: Write) -> State:
    """Return the state after a certain write."""
    state = havoc(types, state, (write,))
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


def _is_retraction(write: Write) -> bool:
    return isinstance(write, RelationWrite) and write.value is False


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
