"""Evidence for the facts of a world model: sensed, reported by a device, idealised, or only assumed.

A ledger keeps the writes of a run. The write that decides the evidence for a fact is the last one that stated it, or
that made it true or false by an axiom: to put an object into a gripper also takes it out of the box.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias, assert_never

import msgspec
from msgspec.structs import replace

from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.difference import changes_back
from skillc_runtime.world.state.facts import ClassFact, Evidence, Fact, PropertyFact, RelationFact
from skillc_runtime.world.state.properties import value_at
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import are_equal
from skillc_runtime.world.state.world_state import WorldState

EvidenceRule: TypeAlias = Callable[[Sequence[Change], Evidence], Evidence]
"""Returns the evidence that counts for changes and the evidence that their writer states."""

_STRENGTH: dict[Evidence | None, int] = {"assumed": 0, "idealised": 1, "reported": 2, "sensed": 3, None: 4}

MAX_WRITES = 500
"""The number of writes that are kept separately; older ones are merged, and the weakest evidence counts."""


class DecidingWrite(msgspec.Struct, frozen=True):
    """The write that decides the evidence for a fact: its number, from 1, its evidence and its origin.

    `evidence` is None for a write that this run did not make: a person's, or another program's.
    """

    number: int
    evidence: Evidence | None
    origin: str


def describe_evidence(known: DecidingWrite | None) -> str:
    """Return how a fact is known, such as `assumed by Place`."""
    if known is None or known.evidence is None:
        return "given"
    return f"{known.evidence} by {known.origin}" if known.origin else known.evidence


class UndoableWrite(msgspec.Struct, frozen=True):
    """A write as it is stored: its evidence, its origin, its changes, and those that lead back."""

    evidence: Evidence | None
    origin: str
    changes: tuple[Change, ...]
    undo: tuple[Change, ...]


@dataclass(frozen=True)
class LedgerWrite:
    """A write, or several that are kept as one with the weakest evidence; they lead from one version to another.

    `stored` is how it was read from a store, if it was.
    """

    decides: DecidingWrite
    changes: tuple[Change, ...]
    before: WorldState
    after: WorldState
    stored: UndoableWrite | None = None

    @cached_property
    def undoable(self) -> UndoableWrite:
        """The write as it is stored."""
        if self.stored is not None:
            return self.stored
        undo = changes_back(self.changes, self.before, self.after)
        return UndoableWrite(self.decides.evidence, self.decides.origin, self.changes, undo)


class EvidenceLedger:
    """The writes since a world model was created; facts that none of them concerns were given with the scene."""

    def __init__(self) -> None:
        self._entries: list[LedgerWrite] = []
        self.count = 0

    def add(
        self,
        changes: tuple[Change, ...],
        before: WorldState,
        after: WorldState,
        evidence: Evidence | None,
        origin: str,
    ) -> None:
        """Add a write."""
        self._append(LedgerWrite(DecidingWrite(self.count + 1, evidence, origin), changes, before, after))

    def _append(self, write: LedgerWrite) -> None:
        self.count += 1
        self._entries.append(write)
        if len(self._entries) > MAX_WRITES:
            self._entries[:2] = [_merge(*self._entries[:2])]

    @property
    def writes(self) -> tuple[LedgerWrite, ...]:
        """All writes, the oldest first: that one may stand for several."""
        return tuple(self._entries)

    def list_undoable(self) -> tuple[UndoableWrite, ...]:
        """Return all writes as they are stored, the oldest first."""
        return tuple(each.undoable for each in self._entries)

    @property
    def merged(self) -> LedgerWrite | None:
        """The oldest writes, as one; None if there are none."""
        return self._entries[0] if self._entries else None

    def restore(self, state: WorldState, writes: Sequence[UndoableWrite]) -> None:
        """Add writes, the last of which led to `state`, each with the versions before and after it."""
        versions = [state]
        for write in reversed(writes):
            versions.append(versions[-1].with_changes(write.undo))
        for write, before, after in zip(writes, versions[:0:-1], versions[-2::-1], strict=True):
            decides = DecidingWrite(self.count + 1, write.evidence, write.origin)
            self._append(LedgerWrite(decides, write.changes, before, after, write))

    @property
    def separate(self) -> int:
        """The number of writes that are kept separately, after those that are merged."""
        return max(0, len(self._entries) - 1)

    def drop_last(self) -> None:
        """Remove the last write, which was undone: its facts have their former evidence again."""
        self._entries.pop()

    def deciding_write(self, fact: Fact, state: WorldState) -> DecidingWrite | None:
        """Return the write that decides the evidence for a fact of the current `state`; None for a given fact."""
        match fact:
            case RelationFact(relation=relation) if relation in state.axioms.computed:
                defined = relation in state.vocabulary.definitions
                known = () if defined else state.vocabulary.relations[relation].computed_from
                read = [each for each in known if each in state.vocabulary.properties]
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
        """Return the pairs of a relation, with a subject or an object, that held before any of the writes."""
        found = set[tuple[str, str]]()
        for entry in self._entries:
            found.update(entry.before.pairs(relation, subject, object_))
        return found

    def _last(self, fact: Fact) -> DecidingWrite | None:
        for entry in reversed(self._entries):
            if any(_is_stated_by(change, fact, entry.after) for change in entry.changes) or _is_changed_by(fact, entry):
                return entry.decides
        return None


def weakest(found: Iterable[DecidingWrite | None]) -> DecidingWrite | None:
    """Return the write with the weakest evidence, for facts that are all needed; None if all were given."""
    writes = [each for each in found if each is not None]
    return min(writes, key=_weakness, default=None)


def _weakness(write: DecidingWrite) -> tuple[int, int]:
    """Order writes: the weakest first, of equally strong ones the last."""
    return _STRENGTH[write.evidence], -write.number


def strongest(found: Iterable[DecidingWrite | None]) -> DecidingWrite | None:
    """Return the write with the strongest evidence, for facts of which one is enough; None if one is given."""
    writes = tuple(found)
    if None in writes:
        return None
    return max(
        (each for each in writes if each), key=lambda each: (_STRENGTH[each.evidence], each.number), default=None
    )


def stated_fact(change: Change) -> Fact | None:
    """Return the fact that a change states; None for a change of an individual as a whole."""
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
    """Whether a change states a fact, directly or by what its relation implies."""
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


def _is_changed_by(fact: Fact, entry: LedgerWrite) -> bool:
    """Whether a write changed the truth of a fact, or a value, even if it did not state it."""
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
    """Yield the facts from which a true one follows: itself, and every link of a chain between its ends."""
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
    """Yield true facts that exclude a false one: the other object or subject of a functional relation."""
    for relation, flipped in state.axioms.implied.get(fact.relation, ()):
        term = state.vocabulary.relations[relation]
        start, end = (fact.object, fact.subject) if flipped else (fact.subject, fact.object)
        if term.functional:
            yield from (RelationFact(start, relation, each) for each in sorted(state.objects(start, relation)))
        if term.inverse_functional:
            yield from (RelationFact(each, relation, end) for each in sorted(state.subjects(relation, end)))


def _merge(one: LedgerWrite, other: LedgerWrite) -> LedgerWrite:
    merged = replace(min(one.decides, other.decides, key=_weakness), number=other.decides.number)
    changes = {stated_fact(each) or each: each for each in (*one.changes, *other.changes)}
    return LedgerWrite(merged, tuple(changes.values()), one.before, other.after)
