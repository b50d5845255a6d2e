"""Relations that a library defines by conditions: whether they hold, and why not.

A definition may lead back to itself. Then the relation holds as far as that follows in some number of steps: the least
fixed point. It is found for what is asked only: a pair is evaluated as if no pair of the same group held of which that
is not known yet, and again when one of those that it has asked for turns out to hold. Since a definition leads
back to itself through no negation, nothing that was found to hold has to be taken back.
"""

from __future__ import annotations

from collections import defaultdict
from threading import local
from typing import TypeAlias
from weakref import WeakKeyDictionary

from skillc_rdf.vocabulary.types import Definition, RelationTerm, local_name
from skillc_runtime.cancellation import check_current
from skillc_runtime.world.eval.conditions import compile_condition
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import Bindings
from skillc_runtime.world.eval.scope import ConditionTest
from skillc_runtime.world.state.computed import ClassIndex, ComputedRelation
from skillc_runtime.world.state.world_state import WorldState

Pair: TypeAlias = tuple[str, str, str]
"""A relation, a subject and an object."""


class DefinedRelation(ComputedRelation):
    """A relation with the condition that defines it."""

    def __init__(self, term: RelationTerm, definition: Definition) -> None:
        super().__init__(term)
        self._definition = definition
        self._test: ConditionTest = compile_condition(definition.condition)
        self._known = WeakKeyDictionary[WorldState, dict[Pair, bool]]()

    def holds(self, state: ClassIndex, subject: str, object_: str) -> bool:
        """Whether the relation holds; EvaluationError if its condition cannot be evaluated."""
        return self.takes(state, subject, object_) and self._follows(_as_world(state), subject, object_)

    def is_so(self, state: WorldState, subject: str, object_: str) -> bool:
        """Whether the condition holds of two individuals."""
        return self._test(state, self._bind(subject, object_))

    def _bind(self, subject: str, object_: str) -> Bindings:
        return {self._definition.subject.name: subject, self._definition.object.name: object_}

    def _follows(self, state: WorldState, subject: str, object_: str) -> bool:
        group, pair = self._definition.group, (self._term.iri, subject, object_)
        if not group:
            return self.is_so(state, subject, object_)
        search = next((each for each in _searches() if each.state is state and each.group == group), None)
        if search is not None:
            return search.ask(pair)
        known = self._known.setdefault(state, {})
        if pair not in known:
            known |= _Search(state, group).find(pair)
        return known[pair]

    def _ask(self, state: ClassIndex, subject: str, object_: str) -> str | None:
        world, explained = _as_world(state), _explained()
        if self._follows(world, subject, object_):
            return None
        if self._term.iri in explained:
            return f"nothing leads there by {local_name(self._term.iri)}"
        explained.add(self._term.iri)
        try:
            return explain(self._definition.condition, world, self._bind(subject, object_), world.vocabulary)
        finally:
            explained.discard(self._term.iri)


def _as_world(state: ClassIndex) -> WorldState:
    assert isinstance(state, WorldState)
    return state


class _Search:
    """Which pairs of a group of relations hold in a version of the world, among those that one pair asks for."""

    def __init__(self, state: WorldState, group: tuple[str, ...]) -> None:
        self.state, self.group = state, group
        self._holding = set[Pair]()
        self._asked_by: defaultdict[Pair, set[Pair]] = defaultdict(set)
        self._waiting: list[Pair] = []
        self._current: Pair | None = None

    def find(self, pair: Pair) -> dict[Pair, bool]:
        """Return which of the pairs hold that had to be looked at for this one, itself included."""
        searches = _searches()
        searches.append(self)
        try:
            self.ask(pair)
            while self._waiting:
                check_current()
                self._evaluate(self._waiting.pop())
        finally:
            searches.remove(self)
        return {each: each in self._holding for each in self._asked_by}

    def ask(self, pair: Pair) -> bool:
        """Whether the pair is known to hold; if not, it will be looked at, and again whoever has asked for it."""
        if pair not in self._asked_by:
            self._waiting.append(pair)
        asking = self._asked_by[pair]
        if self._current is not None:
            asking.add(self._current)
        return pair in self._holding

    def _evaluate(self, pair: Pair) -> None:
        if pair in self._holding:
            return
        relation = self.state.axioms.computed[pair[0]]
        assert isinstance(relation, DefinedRelation)
        self._current = pair
        if relation.is_so(self.state, pair[1], pair[2]):
            self._holding.add(pair)
            self._waiting += self._asked_by[pair] - self._holding
        self._current = None


_here = local()
"""The searches, and what is being explained, of each thread."""


def _searches() -> list[_Search]:
    found: list[_Search] = _here.__dict__.setdefault("searches", [])
    return found


def _explained() -> set[str]:
    found: set[str] = _here.__dict__.setdefault("explained", set())
    return found
