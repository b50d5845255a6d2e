"""How the facts of a world model are known: what was sensed, what a device reported, what was only assumed.

A ledger keeps the writes of a run. The write that decides how a fact is known is the last one that stated it or that
made it true or false, whatever axiom led there: who puts a thing into a gripper takes it out of the box.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, assert_never

from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.facts import ClassFact, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.properties import value_at
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import are_equal
from skillc_runtime.world.state.world_state import WorldState

Evidence: TypeAlias = Literal["sensed", "reported", "assumed"]
"""`sensed`: measured; `reported`: a device says so of itself; `assumed`: nothing looked."""

_STRENGTH: dict[Evidence | None, int] = {"assumed": 0, "reported": 1, "sensed": 2, None: 3}

MAX_WRITES = 500
"""So many writes are kept apart; of older ones, taken together, the weakest evidence counts."""


@dataclass(frozen=True, slots=True)
class DecidingWrite:
    """The write that decides how a fact is known: its number, from 1 on, and who made it.

    `evidence` is None for a write that is no claim of this run: a person's, or another program's.
    """

    number: int
    evidence: Evidence | None
    origin: str


@dataclass(frozen=True, slots=True)
class _Entry:
    write: DecidingWrite
    changes: tuple[Change, ...]
    before: WorldState
    after: WorldState


class EvidenceLedger:
    """The writes since a world model was made; facts that none of them concerns were given with the scene."""

    def __init__(self) -> None:
        self._entries: list[_Entry] = []
        self.count = 0

    def add(
        self,
        changes: tuple[Change, ...],
        before: WorldState,
        after: WorldState,
        evidence: Evidence | None,
        origin: str,
    ) -> None:
        """Take in a write."""
        self.count += 1
        self._entries.append(_Entry(DecidingWrite(self.count, evidence, origin), changes, before, after))
        if len(self._entries) > MAX_WRITES:
            self._entries[:2] = [_merge(*self._entries[:2])]

    def drop_last(self) -> None:
        """Forget the last write, which was taken back: what it concerned is known again as it was before."""
        self._entries.pop()

    def deciding_write(self, fact: Fact, state: WorldState) -> DecidingWrite | None:
        """Return the write that decides how a fact, true in the present `state`, is known; None where it was given."""
        match fact:
            case RelationFact(relation=relation) if relation in state.axioms.computed:
                term = state.vocabulary.relations[relation]
                read = [each for each in term.computed_from if each in state.vocabulary.properties]
                inputs = [PropertyFact(individual, each) for individual in (fact.subject, fact.object) for each in read]
                return weakest(map(self._last, inputs)) or self._last(fact)
            case RelationFact() if fact.holds:
                return weakest(map(self._last, _premises(fact, state)))
            case RelationFact():
                excluding = (self.deciding_write(each, state) for each in _excluding_facts(fact, state))
                return strongest((self._last(fact), *excluding))
            case PropertyFact() | ClassFact():
                return self._last(fact)
            case _:
                assert_never(fact)

    def formerly_true(self, relation: str, subject: str | None, object_: str | None) -> set[tuple[str, str]]:
        """Return the pairs of a relation, with a subject or an object, that held before some write."""
        found = set[tuple[str, str]]()
        for entry in self._entries:
            found.update(pairs(entry.before, relation, subject, object_))
        return found

    def _last(self, fact: Fact) -> DecidingWrite | None:
        for entry in reversed(self._entries):
            if any(_is_stated_by(change, fact, entry.after) for change in entry.changes) or _is_changed_by(fact, entry):
                return entry.write
        return None


def weakest(found: Iterable[DecidingWrite | None]) -> DecidingWrite | None:
    """Return the weakest of what several facts, which are all needed, rest on; None where all were given."""
    there = [each for each in found if each is not None]
    return min(there, key=lambda each: (_STRENGTH[each.evidence], -each.number), default=None)


def strongest(found: Iterable[DecidingWrite | None]) -> DecidingWrite | None:
    """Return the strongest of what alternatives, of which one is enough, rest on."""
    there = tuple(found)
    if None in there:
        return None
    return max((each for each in there if each), key=lambda each: (_STRENGTH[each.evidence], each.number), default=None)


def pairs(state: WorldState, relation: str, subject: str | None, object_: str | None) -> Iterable[tuple[str, str]]:
    """Return the pairs of which a relation holds, with a subject or an object where they are given."""
    if subject is not None:
        return [(subject, each) for each in state.objects(subject, relation) if object_ in (None, each)]
    if object_ is not None:
        return [(each, object_) for each in state.subjects(relation, object_)]
    return state.pairs(relation)


def stated_fact(change: Change) -> Fact | None:
    """Return the fact that a change states; None for one about an individual as a whole."""
    match change:
        case AddRelation(subject, relation, object_):
            return RelationFact(subject, relation, object_)
        case RemoveRelation(subject, relation, object_):
            return RelationFact(subject, relation, object_, holds=False)
        case SetProperty(individual, property_, _) | ClearProperty(individual, property_):
            return PropertyFact(individual, property_)
        case AddIndividual() | RemoveIndividual():
            return None
        case _:
            assert_never(change)


def _is_stated_by(change: Change, fact: Fact, state: WorldState) -> bool:
    """Whether a change states a fact, by itself or by what its relation implies."""
    match change, fact:
        case AddRelation(subject, relation, object_), RelationFact(holds=True):
            return _implies(state, (subject, relation, object_), (fact.subject, fact.relation, fact.object))
        case RemoveRelation(subject, relation, object_), RelationFact(holds=False):
            return _implies(state, (fact.subject, fact.relation, fact.object), (subject, relation, object_))
        case AddIndividual(individual, types), ClassFact(holds=True):
            return individual == fact.individual and fact.cls in types
        case RemoveIndividual(individual), PropertyFact() | ClassFact():
            return individual == fact.individual
        case _:
            return stated_fact(change) == fact


def _implies(state: WorldState, one: tuple[str, str, str], other: tuple[str, str, str]) -> bool:
    subject, relation, object_ = one
    reached = state.axioms.implied.get(relation, ())
    return any(other == ((object_, x, subject) if flipped else (subject, x, object_)) for x, flipped in reached)


def _is_changed_by(fact: Fact, entry: _Entry) -> bool:
    """Whether a write made a fact true that was not, or changed a value that is computed."""
    before, after = entry.before, entry.after
    try:
        match fact:
            case RelationFact(subject, relation, object_):
                return before.holds(subject, relation, object_) != after.holds(subject, relation, object_)
            case ClassFact(individual, cls, _):
                return before.is_a(individual, cls) != after.is_a(individual, cls)
            case PropertyFact(individual, property_):
                old, new = value_at(before, individual, property_), value_at(after, individual, property_)
                return (old is None) != (new is None) or (
                    old is not None and new is not None and not are_equal(old, new)
                )
            case _:
                assert_never(fact)
    except EvaluationError:
        return False


def _premises(fact: RelationFact, state: WorldState) -> Iterator[RelationFact]:
    """Yield the facts that a true one follows from: itself, and of a chain every link between its ends."""
    yield fact
    axioms, relation = state.axioms, fact.relation
    if relation not in axioms.transitive and not axioms.carriers[relation]:
        return
    inner = state.objects(fact.subject, relation) & state.subjects(relation, fact.object)
    nodes = {fact.subject, fact.object, *inner}
    for source, flipped in axioms.sources[relation]:
        for start in sorted(nodes):
            for end in sorted(nodes & state.asserted[source].forward.get(start)):
                if (start, end) != ((fact.object, fact.subject) if flipped else (fact.subject, fact.object)):
                    yield RelationFact(start, source, end)


def _excluding_facts(fact: RelationFact, state: WorldState) -> Iterator[RelationFact]:
    """Yield true facts that a false one follows from: the other value of a functional relation, the other holder."""
    for relation, flipped in state.axioms.implied.get(fact.relation, ()):
        term = state.vocabulary.relations[relation]
        start, end = (fact.object, fact.subject) if flipped else (fact.subject, fact.object)
        if term.functional:
            yield from (RelationFact(start, relation, each) for each in sorted(state.objects(start, relation)))
        if term.inverse_functional:
            yield from (RelationFact(each, relation, end) for each in sorted(state.subjects(relation, end)))


def _merge(one: _Entry, other: _Entry) -> _Entry:
    weaker = one.write if _is_weaker(one, other) else other.write
    kept = replace(weaker, number=other.write.number)
    changes = {stated_fact(each) or each: each for each in (*one.changes, *other.changes)}
    return _Entry(kept, tuple(changes.values()), one.before, other.after)


def _is_weaker(one: _Entry, other: _Entry) -> bool:
    return _STRENGTH[one.write.evidence] < _STRENGTH[other.write.evidence]
