"""The seam between a world model and what keeps its transactions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import pyoxigraph as ox

from skillc_runtime.world.changes import Change
from skillc_runtime.world.event import ChangeEvent


class StoreError(RuntimeError):
    """A store that cannot be used; the message names the store, what is wrong with it and what to do."""


@dataclass(frozen=True, slots=True)
class Transaction:
    """A write that the store has: `sequence` counts them from 1, without gaps."""

    sequence: int
    origin: str
    changes: tuple[Change, ...]


@dataclass(frozen=True, slots=True)
class Kept:
    """What a store holds after the transaction `sequence`: all facts as triples, and which scene they began with.

    Triples about classes and prefixes are those that the scene declared beside the vocabulary of its library.
    """

    sequence: int
    beginning: str
    triples: tuple[ox.Triple, ...]


class Store(Protocol):
    """Keeps transactions in one order that all who use the store agree on; every method may raise StoreError."""

    def read(self) -> Kept:
        """Return the facts as they are now; no triples in a store that was never written to."""

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction that follows `after`, whole, or return False when there is another already.

        Once this returns True the transaction outlasts the process. The first one fills an empty store with the scene
        that is its origin.
        """

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after the one of that number, in order."""


class Nowhere:
    """The store of a world that ends with its process."""

    def read(self) -> Kept:
        """Return no facts."""
        return Kept(0, "", ())

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Forget the event."""
        return True

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return nothing: nobody else writes."""
        return ()
