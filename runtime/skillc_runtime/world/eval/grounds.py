"""The facts that decide a condition, each with the write that decides its evidence."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from typing import TypeAlias, assert_never

import msgspec

from skillc_model.blocks import narrow_scopes
from skillc_model.conditions import (
    And,
    Compare,
    Condition,
    Exists,
    Forall,
    Given,
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
from skillc_model.traversal import free_variables_in_order, walk
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import Bindings, iri_of
from skillc_runtime.world.state.evidence import DecidingWrite
from skillc_runtime.world.state.facts import ClassFact, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState


class Ground(msgspec.Struct, frozen=True):
    """A fact that decides a condition; `write` is None for a fact given with the scene."""

    fact: Fact
    write: DecidingWrite | None

    @property
    def is_assumed(self) -> bool:
        """Whether this run wrote the fact without sensing it."""
        return self.write is not None and self.write.evidence == "assumed"


Grounds: TypeAlias = tuple[Ground, ...]


def find_grounds(condition: Condition, world: WorldModel, bindings: Bindings) -> Grounds:
    """Return the facts that decide a condition, each once; of alternatives, those with the fewest assumptions."""
    return _Finder(world).of(narrow_scopes(condition), bindings)


class _Finder:
    def __init__(self, world: WorldModel) -> None:
        self._world = world
        self._state: WorldState = world.snapshot()
        self._quantified_before: dict[Hashable, Grounds] = {}

    def of(self, condition: Condition, bindings: Bindings) -> Grounds:
        match condition:
            case Holds(subject, relation, object_):
                return self._related(iri_of(subject, bindings), relation, iri_of(object_, bindings))
            case Compare() | HasProperty():
                return self._known(_values(condition, bindings))
            case IsA(subject, cls):
                iri = str(iri_of(subject, bindings))
                return self._known([ClassFact(iri, cls, self._state.is_a(iri, cls))])
            case Not(body):
                return self.of(body, bindings)
            case And(parts) | Or(parts):
                return self._compound(parts, isinstance(condition, And), bindings)
            case Exists() | Forall():
                return self._remembered(condition, bindings)
            case Same() | Given():
                return ()
            case _:
                assert_never(condition)

    def _compound(self, parts: tuple[Condition, ...], together: bool, bindings: Bindings) -> Grounds:
        """Return the facts of all parts if only all decide, else of the deciding part with the fewest assumptions."""
        alone = [part for part in parts if self._true(part, bindings) is not together]
        if alone:
            return _least_assumed([self.of(part, bindings) for part in alone])
        return _unique(ground for part in parts for ground in self.of(part, bindings))

    def _remembered(self, condition: Exists | Forall, bindings: Bindings) -> Grounds:
        """Return the facts of a quantified condition, found once for the individuals that it reads."""
        values = (bindings.get(name) for name in free_variables_in_order(condition))
        key = (id(condition), *(each if isinstance(each, str) else id(each) for each in values))
        if key not in self._quantified_before:
            self._quantified_before[key] = self._quantified(condition, bindings)
        return self._quantified_before[key]

    def _quantified(self, condition: Exists | Forall, bindings: Bindings) -> Grounds:
        exists = isinstance(condition, Exists)
        members = sorted(self._state.instances(condition.cls))
        scopes = [(each, {**bindings, condition.variable: each}) for each in members]
        alone = [(each, scope) for each, scope in scopes if self._true(condition.body, scope) is exists]
        if alone:
            return _least_assumed([self._member(condition, *one) for one in alone])
        return _unique(ground for one in scopes for ground in self._member(condition, *one))

    def _member(self, condition: Exists | Forall, individual: str, scope: Bindings) -> Grounds:
        return (*self._known([ClassFact(individual, condition.cls)]), *self.of(condition.body, scope))

    def _related(self, subject: str | None, relation: str, object_: str | None) -> Grounds:
        if subject is not None and object_ is not None:
            return self._known(
                [RelationFact(subject, relation, object_, self._state.holds(subject, relation, object_))]
            )
        pairs = sorted(self._state.pairs(relation, subject, object_))
        if pairs:
            return _least_assumed([self._known([RelationFact(start, relation, end)]) for start, end in pairs])
        gone = sorted(self._world.ledger.formerly_true(relation, subject, object_))
        return self._known([RelationFact(start, relation, end, holds=False) for start, end in gone])

    def _known(self, facts: Iterable[Fact]) -> Grounds:
        return tuple(Ground(fact, self._world.deciding_write(fact)) for fact in facts)

    def _true(self, condition: Condition, bindings: Bindings) -> bool | None:
        try:
            return evaluate(condition, self._state, bindings)
        except EvaluationError:
            return None


def _least_assumed(alternatives: list[Grounds]) -> Grounds:
    return min(alternatives, key=lambda found: sum(ground.is_assumed for ground in found))


def _unique(found: Iterable[Ground]) -> Grounds:
    return tuple({ground.fact: ground for ground in found}.values())


def _values(item: msgspec.Struct, bindings: Bindings) -> Iterator[PropertyFact]:
    """Yield the properties that a comparison reads."""
    for each in walk(item):
        match each:
            case PropertyOf(Variable() | Individual() as owner, property_) | HasProperty(owner, property_):
                iri = iri_of(owner, bindings)
                if iri is not None:
                    yield PropertyFact(iri, property_)
