"""Detects that a client of devices, for example a behaviour tree, sends no heartbeats any more."""

from __future__ import annotations

from math import inf

import numpy as np

from skillc_runtime.motion.pose import Array

HEARTBEAT_TIMEOUT_S = 0.25
"""Time without heartbeat after which all devices are stopped; a tree ticks at 50 to 100 Hz."""


class HeartbeatWatchdog:
    """Implements `Watchdog`: a client that has sent a heartbeat must continue until it retires.

    Times `now`: s of the cell; due (1,): when the next heartbeat has to have arrived.
    """

    def __init__(self, timeout_s: float = HEARTBEAT_TIMEOUT_S) -> None:
        self._timeout = timeout_s
        self._last: dict[object, float] = {}
        self._late: set[object] = set()
        self.due: Array = np.full(1, inf)

    def beat(self, who: object, now: float) -> bool:
        """Receive a heartbeat; False if it is too late and devices have been stopped."""
        if who in self._late:
            return False
        self._last[who] = now
        self.due[0] = self._earliest()
        return True

    def retire(self, who: object) -> None:
        """Expect no further heartbeats of a client."""
        self._last.pop(who, None)
        self._late.discard(who)
        self.due[0] = self._earliest()

    def expired(self, now: float) -> bool:
        """Tell, once for each late client, that devices must be stopped."""
        if now <= self.due[0]:
            return False
        late = {who for who, last in self._last.items() if now - last > self._timeout}
        self._late |= late
        self._last = {who: last for who, last in self._last.items() if who not in late}
        self.due[0] = self._earliest()
        return True

    def _earliest(self) -> float:
        """Return the time by which the next heartbeat must arrive."""
        return min(self._last.values(), default=inf) + self._timeout
