"""Committed writes to a world model: the event for listeners, and the log that stores them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

import msgspec

from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.world_state import WorldState


class ChangeEvent(msgspec.Struct, frozen=True):
    """A committed write: the changes, their origin and evidence, and the versions before and after.

    `evidence` is None for writes of others and for undone writes.
    """

    changes: tuple[Change, ...]
    origin: str
    before: WorldState
    after: WorldState
    evidence: Evidence | None = "assumed"


Listener: TypeAlias = Callable[[ChangeEvent], None]


class StoreError(RuntimeError):
    """A store that cannot be used; the message names the store, the problem and what to do."""


class Transaction(msgspec.Struct, frozen=True):
    """A write in the store; `sequence` counts writes from 1, without gaps; `author` is who wrote it, if it is known."""

    sequence: int
    origin: str
    changes: tuple[Change, ...]
    author: str = ""


class TransactionLog(Protocol):
    """Stores transactions in one order for all writers; every method may raise StoreError."""

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction after number `after`; return False when another one has that place.

        A transaction is written completely or not at all, and is durable once this returns True. The first one fills an
        empty store with the scene that is its origin.
        """

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after number `sequence`, in order."""


class NullStore:
    """The log of a world without a store: it keeps nothing."""

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Accept the event without storing it."""
        return True

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return no transactions: nobody else writes."""
        return ()
