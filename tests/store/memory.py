"""The plainest store: a list that several world models share."""

from __future__ import annotations

from collections.abc import Callable

from skillc_runtime.store.store import StoredWorld
from skillc_runtime.store.triples import all_triples
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction
from skillc_runtime.world.state.world_state import WorldState


class MemoryStore:
    """Keeps transactions in a list; `interfere` is called before each write, as if others were faster."""

    def __init__(self) -> None:
        self.written: list[Transaction] = []
        self.state: WorldState | None = None
        self.interfere: Callable[[], None] = lambda: None
        self.broken = False

    def read(self) -> StoredWorld:
        triples = () if self.state is None else tuple(all_triples(self.state))
        return StoredWorld(len(self.written), self.written[0].origin if self.written else "", triples)

    def append(self, event: ChangeEvent, after: int) -> bool:
        interfere, self.interfere = self.interfere, lambda: None
        interfere()
        if self.broken:
            raise StoreError("the store is gone")
        if after != len(self.written):
            return False
        self.written.append(Transaction(after + 1, event.origin, event.changes))
        self.state = event.after
        return True

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        return tuple(self.written[sequence:])
