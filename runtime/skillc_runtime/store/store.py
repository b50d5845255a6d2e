"""What a persistent store of a world offers beside the log of its transactions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import pyoxigraph as ox

from skillc_runtime.world.state.transactions import TransactionLog


@dataclass(frozen=True, slots=True)
class StoredWorld:
    """What a store holds after the transaction `sequence`: all facts as triples, and which scene they began with.

    Triples about classes and prefixes are those that the scene declared beside the vocabulary of its library.
    """

    sequence: int
    beginning: str
    triples: tuple[ox.Triple, ...]


class Store(TransactionLog, Protocol):
    """Keeps the facts of a world and its transactions; every method may raise StoreError."""

    def read(self) -> StoredWorld:
        """Return the facts as they are now; no triples in a store that was never written to."""
