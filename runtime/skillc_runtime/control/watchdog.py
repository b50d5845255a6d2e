"""Notices when whoever moves devices is not heard of any more: a tree that is not ticked, say."""

from __future__ import annotations

from math import inf

HEARTBEAT_TIMEOUT_S = 0.25
"""Silence after which everything is stopped; a tree ticks at 50 to 100 Hz."""


class HeartbeatWatchdog:
    """Implements `Watchdog`: whoever has beaten once must go on until it retires. Times: s of the cell's clock."""

    def __init__(self, patience_s: float = HEARTBEAT_TIMEOUT_S) -> None:
        self._patience = patience_s
        self._last: dict[object, float] = {}
        self._late: set[object] = set()
        self._due = inf

    def beat(self, who: object, now: float) -> bool:
        """Take a sign of life; False when it comes too late and devices have been stopped meanwhile."""
        if who in self._late:
            return False
        self._last[who] = now
        self._due = self._earliest()
        return True

    def retire(self, who: object) -> None:
        """Expect nothing of it any more."""
        self._last.pop(who, None)
        self._late.discard(who)
        self._due = self._earliest()

    def expired(self, now: float) -> bool:
        """Tell, once for everybody who is late, that devices must be stopped."""
        if now <= self._due:
            return False
        late = {who for who, last in self._last.items() if now - last > self._patience}
        self._late |= late
        self._last = {who: last for who, last in self._last.items() if who not in late}
        self._due = self._earliest()
        return True

    def _earliest(self) -> float:
        """Return when the first of all must have beaten again."""
        return min(self._last.values(), default=inf) + self._patience
