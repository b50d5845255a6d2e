"""The world model: the one place where what is known of the world changes, version by version."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from threading import RLock

from skillc_runtime.world.state.axiom_violations import axiom_violations, unknown_term
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
    named_individuals,
)
from skillc_runtime.world.state.difference import changes_between
from skillc_runtime.world.state.evidence import DecidingWrite, Evidence, EvidenceLedger
from skillc_runtime.world.state.facts import Fact
from skillc_runtime.world.state.open_transaction import OpenTransaction
from skillc_runtime.world.state.transactions import ChangeEvent, Listener, NullStore, StoreError, TransactionLog
from skillc_runtime.world.state.world_state import WorldState

MAX_UNDO = 100
"""So many of the last writes can be taken back."""


class WorldError(ValueError):
    """A write that was refused; the message names the axioms it breaks and the facts."""


class WorldModel:
    """The current version of the world, how its facts are known, and whoever wants to hear of the next."""

    def __init__(self, state: WorldState, store: TransactionLog | None = None, sequence: int = 0) -> None:
        """Begin with a version: the one that `store`, if there is one, holds after the transaction `sequence`."""
        self._state = state
        self._store: TransactionLog = store or NullStore()
        self._sequence = sequence
        self._listeners: list[Listener] = []
        self._lock = RLock()
        self._in_transaction = False
        self._past: deque[ChangeEvent] = deque(maxlen=MAX_UNDO)
        self.ledger = EvidenceLedger()

    def snapshot(self) -> WorldState:
        """Return the current version, which never changes."""
        return self._state

    def subscribe(self, listener: Listener) -> Callable[[], None]:
        """Call the listener after every write; return what ends that."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def deciding_write(self, fact: Fact) -> DecidingWrite | None:
        """Return the write that decides how a fact of the current version is known; None for one given at the start."""
        return self.ledger.deciding_write(fact, self._state)

    def commit(self, changes: Iterable[Change], origin: str = "", evidence: Evidence = "assumed") -> ChangeEvent:
        """Make all the changes or, when the world would break an axiom, none: WorldError says which.

        `known` is `sensed` or `reported` only where a device was read for them, now.
        Where others wrote to the store in the meantime, the changes are made to what they left. StoreError when the
        store cannot keep the changes, and then the world stays as it was.
        """
        with self._lock:
            if self._in_transaction:
                raise WorldError("a transaction is open: write to it")
            event = self._commit(tuple(changes), origin, evidence)
        self._notify(event)
        return event

    @contextmanager
    def transaction(self, origin: str = "", evidence: Evidence = "assumed") -> Iterator[OpenTransaction]:
        """Gather writes and commit them all when the block ends; none when it raises, nor when they are refused.

        Other threads wait with their writes for its end, and go on reading. WorldError for one within another.
        """
        with self._lock:
            if self._in_transaction:
                raise WorldError("a transaction is open already: write to it")
            self._in_transaction = True
            try:
                gathered = OpenTransaction(self._state)
                yield gathered
            finally:
                self._in_transaction = False
            event = self._commit(tuple(gathered.changes), origin, evidence) if gathered.changes else None
        if event is not None:
            self._notify(event)

    def undo(self, origin: str = "undo") -> ChangeEvent:
        """Take back the last write that is not taken back yet, as a write of its own; facts are known as before it.

        WorldError when there is none: nothing was written here, others wrote since, or it is more than MAX_UNDO ago.
        """
        with self._lock:
            if self._in_transaction:
                raise WorldError("a transaction is open: end it first")
            self.follow()
            if not self._past:
                raise WorldError("there is nothing to take back: nothing was written here since others wrote")
            last = self._past[-1]
            named = {individual for change in last.changes for individual in named_individuals(change)}
            event = self._check(changes_between(self._state, last.before, named), origin, None)
            if not self._store.append(event, self._sequence):
                raise WorldError("others wrote to the world meanwhile: nothing was taken back")
            self._advance(event)
            self._past.pop()
            self.ledger.drop_last()
        self._notify(event)
        return event

    def follow(self) -> None:
        """Take over what others wrote to the store, and tell whoever listens; StoreError when it cannot be read."""
        events: list[ChangeEvent] = []
        with self._lock:
            for transaction in self._store.since(self._sequence):
                before, self._sequence = self._state, transaction.sequence
                self._state = before.with_changes(transaction.changes)
                event = ChangeEvent(transaction.changes, transaction.origin, before, self._state, None)
                events.append(event)
                self._record(event)
                self._past.clear()
        for event in events:
            self._notify(event)

    def _commit(self, changes: tuple[Change, ...], origin: str, evidence: Evidence) -> ChangeEvent:
        event = self._check(changes, origin, evidence)
        while not self._store.append(event, self._sequence):
            before = self._sequence
            self.follow()
            if self._sequence == before:
                raise StoreError(f"{self._store} refuses a write, although nobody else has written")
            event = self._check(changes, origin, evidence)
        self._advance(event)
        self._past.append(event)
        self._record(event)
        return event

    def _advance(self, event: ChangeEvent) -> None:
        self._state = event.after
        self._sequence += 1

    def _record(self, event: ChangeEvent) -> None:
        self.ledger.add(event.changes, event.before, event.after, event.evidence, event.origin)

    def _check(self, made: tuple[Change, ...], origin: str, evidence: Evidence | None) -> ChangeEvent:
        """Return what the changes would make of the current version; WorldError when that is refused."""
        before = self._state
        strange = [iri for change in made if (iri := unknown_term(before, change)) is not None]
        if strange:
            raise WorldError(f"there is no relation or property {before.vocabulary.short(strange[0])}")
        after = before.with_changes(made)
        problems = [breach.message for change in _effective_changes(made) for breach in axiom_violations(after, change)]
        if problems:
            raise WorldError("; ".join(dict.fromkeys(problems)))
        return ChangeEvent(made, origin, before, after, evidence)

    def _notify(self, event: ChangeEvent) -> None:
        for listener in tuple(self._listeners):
            listener(event)


def _effective_changes(changes: tuple[Change, ...]) -> list[Change]:
    """Return the changes that a later one of the same write does not take back."""
    lasting: list[Change] = []
    for change in changes:
        match change:
            case RemoveIndividual(gone):
                lasting = [each for each in lasting if not _about(each, gone)]
            case RemoveRelation(subject, relation, object_):
                lasting = [each for each in lasting if each != AddRelation(subject, relation, object_)]
            case _:
                lasting.append(change)
    return lasting


def _about(change: Change, individual: str) -> bool:
    match change:
        case AddRelation(subject, _, object_):
            return individual in (subject, object_)
        case AddIndividual(other, _) | SetProperty(other, _, _):
            return other == individual
        case _:
            return False
