"""The protocol of persistent stores of a world."""

from __future__ import annotations

from typing import Protocol

import msgspec
import pyoxigraph as ox

from skillc_runtime.world.state.transactions import TransactionLog


class StoredWorld(msgspec.Struct, frozen=True):
    """The contents of a store after the transaction number `sequence`: all facts as triples.

    `beginning` is the scene with which the store was filled. Triples about classes and prefixes are those that the
    scene declares in addition to the vocabulary of its library.
    """

    sequence: int
    beginning: str
    triples: tuple[ox.Triple, ...]


class Store(TransactionLog, Protocol):
    """Stores the facts of a world and its transactions; every method may raise StoreError."""

    def read(self) -> StoredWorld:
        """Return the current facts; no triples if the store is empty."""
