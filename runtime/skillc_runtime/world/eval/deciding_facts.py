"""The facts that decide conditions, whether they hold or not, for recordings."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from heapq import nsmallest
from itertools import islice
from typing import TypeAlias

import msgspec

from skillc_model.blocks import narrow_scopes
from skillc_model.conditions import (
    Condition,
    Exists,
    Expression,
    Forall,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.traversal import children, free_variables_in_order
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import iri_of
from skillc_runtime.world.eval.identity_cache import IdentityCache
from skillc_runtime.world.eval.quantifiers import candidates
from skillc_runtime.world.state.labels.labelled import LabelledClass, LabelledFact, LabelledIdentity
from skillc_runtime.world.state.labels.labelling import label, label_property, label_relation
from skillc_runtime.world.state.properties import property_of, value_at
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

LISTED = 4
"""The maximum number of facts for an unbound term or a quantifier."""
_Names: TypeAlias = Mapping[str, Value]


_narrowed: IdentityCache[Condition, Condition] = IdentityCache(narrow_scopes)


def deciding_facts(conditions: Iterable[Condition], state: WorldState, bindings: _Names) -> tuple[LabelledFact, ...]:
    """Return the facts that the conditions read, true and false ones, each once.

    Unbound names stand for any individual. Facts that cannot be evaluated are left out.
    """
    seen: set[Hashable] = set()
    narrow = [_narrowed(condition) for condition in conditions]
    found = (fact for condition in narrow for fact in _facts(condition, state, bindings, seen))
    return tuple(dict.fromkeys(found))


def facts_read(expression: Expression, state: WorldState, bindings: _Names) -> tuple[LabelledFact, ...]:
    """Return the facts that an expression reads, each once. Facts that cannot be evaluated are left out."""
    return tuple(dict.fromkeys(_facts(expression, state, bindings, set())))


def _facts(item: msgspec.Struct, state: WorldState, bindings: _Names, seen: set[Hashable]) -> Iterator[LabelledFact]:
    """Yield the facts that a condition reads; `seen` are the quantified ones that were read, with what they read."""
    words = state.vocabulary
    match item:
        case Holds(subject, relation, object_):
            with suppress(EvaluationError):
                yield from _related(iri_of(subject, bindings), relation, iri_of(object_, bindings), state)
        case PropertyOf(Variable() | Individual() as owner, property_) | HasProperty(owner, property_):
            iri = iri_of(owner, bindings)
            yield from _value(iri, property_, state) if iri is not None else ()
        case IsA(subject, cls):
            iri = iri_of(subject, bindings)
            if iri is not None:
                yield LabelledClass(label(iri, words), label(cls, words), state.is_a(iri, cls))
        case Same(left, right):
            one, other = iri_of(left, bindings), iri_of(right, bindings)
            if one is not None and other is not None:
                yield LabelledIdentity(label(one, words), label(other, words), one == other)
        case Or(parts):
            for alternative in _true(parts, state, bindings) or parts:
                yield from _facts(alternative, state, bindings, seen)
        case Exists() | Forall():
            yield from _quantified(item, state, bindings, seen)
        case _:
            for part in children(item):
                yield from _facts(part, state, bindings, seen)


def _quantified(
    item: Exists | Forall, state: WorldState, bindings: _Names, seen: set[Hashable]
) -> Iterator[LabelledFact]:
    values = (bindings.get(name) for name in free_variables_in_order(item))
    key = (id(item), *(each if isinstance(each, str) else id(each) for each in values))
    if key not in seen:
        seen.add(key)
        for individual in _deciding(item, state, bindings):
            yield from _facts(item.body, state, {**bindings, item.variable: individual}, seen)


def _related(subject: str | None, relation: str, object_: str | None, state: WorldState) -> Iterator[LabelledFact]:
    words = state.vocabulary
    if subject is not None and object_ is not None:
        yield label_relation(subject, relation, object_, state.holds(subject, relation, object_), words)
        return
    pairs = nsmallest(LISTED, state.pairs(relation, subject, object_))
    yield from (label_relation(start, relation, end, True, words) for start, end in pairs)
    if not pairs:
        yield label_relation(subject, relation, object_, False, words)


def _value(individual: str, property_: str, state: WorldState) -> Iterator[LabelledFact]:
    """Yield the value of a property, and the numbers from which it was judged if they are known."""
    words = state.vocabulary
    if property_ in words.relations:
        yield from _related(individual, property_, None, state)
        return
    with suppress(EvaluationError):
        yield label_property(individual, property_, property_of(state, individual, property_), words)
    term = words.properties[property_]
    for judged_by in filter(None, (term.measure, term.threshold)):
        number = value_at(state, individual, judged_by)
        if number is not None:
            yield label_property(individual, judged_by, number, words)


def _deciding(condition: Exists | Forall, state: WorldState, bindings: _Names) -> list[str]:
    """Return the first individuals that decide a quantified condition; any of the class if none decides alone."""
    wanted = isinstance(condition, Exists)
    try:
        members = sorted(each for each in candidates(condition)(state, bindings) if state.is_a(each, condition.cls))
        deciding = (
            each
            for each in members
            if evaluate(condition.body, state, {**bindings, condition.variable: each}) == wanted
        )
        return list(islice(deciding, LISTED)) or members[:LISTED]
    except EvaluationError:
        return []


def _true(parts: Sequence[Condition], state: WorldState, bindings: _Names) -> list[Condition]:
    """Return the alternatives that hold; none if one cannot be evaluated."""
    try:
        return [part for part in parts if evaluate(part, state, bindings)]
    except EvaluationError:
        return []
