"""The world model: the only place where facts about the world change, version by version."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from threading import RLock

from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.consistency.axiom_violations import axiom_violations, unknown_term
from skillc_runtime.world.state.consistency.hidden_truth import NOTHING_HIDDEN
from skillc_runtime.world.state.consistency.judgements import add_judgements
from skillc_runtime.world.state.difference import changes_back
from skillc_runtime.world.state.evidence import DecidingWrite, EvidenceLedger, EvidenceRule
from skillc_runtime.world.state.facts import Evidence, Fact
from skillc_runtime.world.state.open_transaction import OpenTransaction
from skillc_runtime.world.state.transactions import (
    ChangeEvent,
    Listener,
    NullStore,
    StoreError,
    Transaction,
    TransactionLog,
)
from skillc_runtime.world.state.world_state import WorldState

MAX_UNDO = 100
"""The number of last writes that can be undone."""
LOCK_S = 30.0
"""How long a write waits for the end of a transaction of another thread."""
MAX_ATTEMPTS = 1000
"""How often a write is repeated because another process wrote at the same time."""


class WorldError(ValueError):
    """A write that was rejected; the message names the violated axioms and the facts."""


class WorldModel:
    """The current version of the world, the evidence for its facts, and the listeners for new versions."""

    def __init__(self, state: WorldState, store: TransactionLog | None = None, sequence: int = 0) -> None:
        """Start with a version; with a `store`, the one that it holds after the transaction number `sequence`."""
        self._state = state
        self._store: TransactionLog = store or NullStore()
        self._sequence = sequence
        self._listeners: list[Listener] = []
        self._lock = RLock()
        self._in_transaction = False
        self._past: deque[ChangeEvent] = deque(maxlen=MAX_UNDO)
        self.ledger = EvidenceLedger()
        self._rule: EvidenceRule = lambda _changes, stated: stated

    def snapshot(self) -> WorldState:
        """Return the current version, which never changes."""
        return self._state

    def forget_hidden(self) -> None:
        """Know nothing of what is true but not known: the cell is no simulation."""
        with self._locked():
            self._state = replace(self._state, hidden=NOTHING_HIDDEN)

    @property
    def sequence(self) -> int:
        """The number of the last transaction in its store, with those that it had before."""
        return self._sequence

    @property
    def is_stored(self) -> bool:
        """Whether it is in a store, to which others may write."""
        return not isinstance(self._store, NullStore)

    def subscribe(self, listener: Listener) -> Callable[[], None]:
        """Call the listener after every write; return a function that ends the subscription."""
        self._listeners.append(listener)
        return lambda: self._listeners.remove(listener)

    def weigh_evidence(self, rule: EvidenceRule) -> None:
        """Let a rule decide the evidence of all writes from now on, for example because a cell idealises contact."""
        self._rule = rule

    def deciding_write(self, fact: Fact) -> DecidingWrite | None:
        """Return the write that decides the evidence for a current fact; None for a fact given at the start."""
        return self.ledger.deciding_write(fact, self._state)

    def commit(self, changes: Iterable[Change], origin: str = "", evidence: Evidence | None = "assumed") -> ChangeEvent:
        """Apply all changes, or none if the world would violate an axiom: WorldError names it.

        What is judged from numbers that they set follows them.
        `evidence` may be `sensed`, `reported` or `idealised` only if a device was read for these changes now; it is
        None for what a person states.
        If others wrote to the store in the meantime, the changes are applied to the version that they left. StoreError
        when the store cannot save the changes; the world then stays as it was.
        """
        with self._locked():
            if self._in_transaction:
                raise WorldError("a transaction is open: write to it")
            event = self._commit(tuple(changes), origin, evidence)
        self._notify(event)
        return event

    @contextmanager
    def transaction(self, origin: str = "", evidence: Evidence = "assumed") -> Iterator[OpenTransaction]:
        """Collect writes and commit them together when the block ends; none if it raises or an axiom is violated.

        Writes of other threads wait for the end of the block, for up to LOCK_S; reads do not. WorldError for a nested
        transaction.
        """
        with self._locked():
            if self._in_transaction:
                raise WorldError("a transaction is open already: write to it")
            self._in_transaction = True
            try:
                transaction = OpenTransaction(self._state)
                yield transaction
            finally:
                self._in_transaction = False
            event = self._commit(tuple(transaction.changes), origin, evidence) if transaction.changes else None
        if event is not None:
            self._notify(event)

    def undo(self, origin: str = "undo") -> ChangeEvent:
        """Undo the last write that is not undone yet, with a new write; its facts have their former evidence again.

        WorldError when there is none: nothing was written here, others wrote since, or it is more than MAX_UNDO ago.
        """
        with self._locked():
            if self._in_transaction:
                raise WorldError("a transaction is open: end it first")
            self.follow()
            if not self._past:
                raise WorldError("there is nothing to undo: nothing was written here since others wrote")
            last = self._past[-1]
            event = self._check(changes_back(last.changes, last.before, self._state), origin, None)
            if not self._store.append(event, self._sequence):
                raise WorldError("others wrote to the world meanwhile: nothing was undone")
            self._advance(event)
            self._past.pop()
            self.ledger.drop_last()
        self._notify(event)
        return event

    def follow(self) -> None:
        """Apply what others wrote to the store and call the listeners; StoreError when it cannot be read.

        What comes before a transaction that this world does not allow is applied.
        """
        events: list[ChangeEvent] = []
        try:
            with self._locked():
                for transaction in self._store.since(self._sequence):
                    event = self._check_foreign(transaction)
                    events.append(event)
                    self._advance(event)
                    self._record(event)
                    self._past.clear()
        finally:
            for event in events:
                self._notify(event)

    @contextmanager
    def _locked(self) -> Iterator[None]:
        """Exclude the writes of other threads; WorldError if one of them does not end its transaction."""
        if not self._lock.acquire(timeout=LOCK_S):
            raise WorldError(f"another thread has a transaction open for more than {LOCK_S:g} s")
        try:
            yield
        finally:
            self._lock.release()

    def _commit(self, changes: tuple[Change, ...], origin: str, evidence: Evidence | None) -> ChangeEvent:
        event = self._check(add_judgements(self._state, changes), origin, evidence)
        for _ in range(MAX_ATTEMPTS):
            if self._store.append(event, self._sequence):
                self._advance(event)
                self._past.append(event)
                self._record(event)
                return event
            before = self._sequence
            self.follow()
            if self._sequence == before:
                raise StoreError(f"{self._store} rejects a write, although no other process has written")
            event = self._check(add_judgements(self._state, changes), origin, evidence)
        raise StoreError(f"{self._store} cannot be written to, because other processes write to it all the time")

    def _advance(self, event: ChangeEvent) -> None:
        self._state = event.after
        self._sequence += 1

    def _record(self, event: ChangeEvent) -> None:
        self.ledger.add(event.changes, event.before, event.after, event.evidence, event.origin)

    def _check(self, changes: tuple[Change, ...], origin: str, evidence: Evidence | None) -> ChangeEvent:
        """Return the event that the changes would cause; WorldError if they are rejected."""
        before = self._state
        unknown = [iri for change in changes if (iri := unknown_term(before, change)) is not None]
        if unknown:
            raise WorldError(f"there is no relation or property {before.vocabulary.short(unknown[0])}")
        after = before.with_changes(changes)
        problems = [
            violation.message for change in _effective_changes(changes) for violation in axiom_violations(after, change)
        ]
        if problems:
            raise WorldError("; ".join(dict.fromkeys(problems)))
        return ChangeEvent(changes, origin, before, after, None if evidence is None else self._rule(changes, evidence))

    def _check_foreign(self, transaction: Transaction) -> ChangeEvent:
        """Return the event of a transaction of others; StoreError if this world, or its vocabulary, rejects it."""
        author = f" ({transaction.author})" if transaction.author else ""
        try:
            return self._check(transaction.changes, transaction.origin + author, None)
        except WorldError as error:
            raise StoreError(
                f"transaction {transaction.sequence} in {self._store} does not go with these skills: {error}; "
                "use the library of those who write to it, or fill it again with --reset"
            ) from error

    def _notify(self, event: ChangeEvent) -> None:
        for listener in tuple(self._listeners):
            listener(event)


def _effective_changes(changes: tuple[Change, ...]) -> list[Change]:
    """Return the changes that no later change of the same write undoes."""
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
