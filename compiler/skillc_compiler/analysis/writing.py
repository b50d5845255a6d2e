"""What is known once something was certainly written."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.learning import single_sides
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.writes import Assigned, Ended, Related, Valued, Write, canonical, write_of
from skillc_model.conditions import (
    Anything,
    Compare,
    Condition,
    Effect,
    HasProperty,
    Holds,
    Individual,
    PropertyOf,
    Variable,
)


def applied(sorts: Sorts, state: State, effects: Iterable[Effect]) -> State:
    """Return the state after effects, what they retract first, as the runtime does it."""
    writes = sorted((write_of(effect) for effect in effects), key=lambda w: not _retracts(w))
    for write in writes:
        state = written(sorts, state, write)
    return state


def written(sorts: Sorts, state: State, write: Write) -> State:
    """Return the state after something was certainly written."""
    state = forgotten(sorts, state, (write,))
    match write:
        case Related(value=True):
            return _asserted(sorts, state, write)
        case Related(value=False):
            return _retracted(sorts, state, write)
        case Valued(subject=Variable() | Individual() as subject, property=iri, value=value):
            owner = state.same.get(subject.name, subject) if isinstance(subject, Variable) else subject
            facts: dict[Condition, bool] = {HasProperty(owner, iri): True}
            if value is not None:
                right = state.same.get(value.name, value) if isinstance(value, Variable) else value
                facts[Compare(PropertyOf(owner, iri), "==", right)] = True
            return state.having(facts)
        case Related() | Valued() | Assigned() | Ended():
            return state
        case _:
            assert_never(write)


def _retracts(write: Write) -> bool:
    return isinstance(write, Related) and write.value is False


def _asserted(sorts: Sorts, state: State, write: Related) -> State:
    subject, relation, object_ = canonical(sorts, state, write)
    if isinstance(subject, Anything) or isinstance(object_, Anything):
        return state
    axioms = sorts.axioms
    facts: dict[Condition, bool] = {}
    for above, turned in axioms.implied.get(relation, ((relation, False),)):
        facts[Holds(object_, above, subject) if turned else Holds(subject, above, object_)] = True
    return state.replaced(facts={**state.facts, **facts}, alone={**state.alone, **single_sides(axioms, facts)})


def _retracted(sorts: Sorts, state: State, write: Related) -> State:
    subject, relation, object_ = canonical(sorts, state, write)
    facts: dict[Condition, bool] = {}
    alone = dict(state.alone)
    for source, turned in sorts.axioms.sources.get(relation, ((relation, False),)):
        if source in sorts.axioms.loose:
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
    return state.replaced(facts={**state.facts, **facts}, alone=alone)
