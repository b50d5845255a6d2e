"""Writes to a world model that were made: what listeners hear of them, and the log that keeps them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.evidence import Evidence
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class ChangeEvent:
    """A write that was made: the changes, who made them, how they are known, and the versions before and after.

    `known` is None for what others wrote, and for what was taken back.
    """

    changes: tuple[Change, ...]
    origin: str
    before: WorldState
    after: WorldState
    evidence: Evidence | None = "assumed"


Listener: TypeAlias = Callable[[ChangeEvent], None]


class StoreError(RuntimeError):
    """A store that cannot be used; the message names the store, what is wrong with it and what to do."""


@dataclass(frozen=True, slots=True)
class Transaction:
    """A write that the store has: `sequence` counts them from 1, without gaps."""

    sequence: int
    origin: str
    changes: tuple[Change, ...]


class TransactionLog(Protocol):
    """Keeps transactions in one order that all who write to it agree on; every method may raise StoreError."""

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction that follows `after`, whole, or return False when there is another already.

        Once this returns True the transaction outlasts the process. The first one fills an empty store with the scene
        that is its origin.
        """

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after the one of that number, in order."""


class NullStore:
    """The log of a world that ends with its process."""

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Forget the event."""
        return True

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return nothing: nobody else writes."""
        return ()
