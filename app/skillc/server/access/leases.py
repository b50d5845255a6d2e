"""Leases: while a client has the lease of a cell, only that client may command it; everybody may watch and stop it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from skillc.contract.cell import Lease


class LeaseHeld(Exception):
    """Another client has the lease; the message says who, and for how long."""


@dataclass(slots=True)
class Leases:
    """The leases of the cells of a server. They end with their time and with the server; `clock` is monotonic, in s."""

    clock: Callable[[], float] = time.monotonic
    _held: dict[str, tuple[str, float]] = field(default_factory=dict)

    def find(self, cell: str) -> Lease:
        """Return the lease of a cell."""
        owner, end = self._held.get(cell, (None, 0.0))
        remaining_s = end - self.clock()
        return Lease(cell, owner, remaining_s) if remaining_s > 0.0 else Lease(cell, None, 0.0)

    def take(self, cell: str, owner: str, duration_s: float, takeover: bool) -> Lease:
        """Take the lease of a cell, or prolong it. LeaseHeld if another client has it, unless it is a takeover."""
        if not takeover:
            self.check(cell, owner)
        self._held[cell] = owner, self.clock() + duration_s
        return self.find(cell)

    def release(self, cell: str, owner: str) -> None:
        """Give the lease of a cell back. LeaseHeld if another client has it."""
        self.check(cell, owner)
        self._held.pop(cell, None)

    def check(self, cell: str, client: str) -> None:
        """Raise LeaseHeld if another client has the lease of a cell."""
        lease = self.find(cell)
        if lease.owner not in (None, client):
            raise LeaseHeld(
                f"`{lease.owner}` has the lease of {cell} for {lease.remaining_s:.0f} s yet; "
                "everybody may stop the cell, and `admin` may take the lease over"
            )
