"""Limits how often somebody may do something: token buckets."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field

MAX_BUCKETS = 10_000


@dataclass(slots=True)
class TokenBuckets:
    """Each key may do `burst` things at once, and `per_s` things a second in the long run.

    Keys that were not seen for longest are forgotten when there are more than MAX_BUCKETS.
    """

    per_s: float
    burst: float
    clock: Callable[[], float] = time.monotonic
    _buckets: OrderedDict[str, tuple[float, float]] = field(default_factory=OrderedDict)

    def take(self, key: str) -> bool:
        """Take one from a key's bucket; return whether there was one."""
        now = self.clock()
        left, at = self._buckets.pop(key, (self.burst, now))
        left = min(self.burst, left + (now - at) * self.per_s)
        taken = left >= 1.0
        self._buckets[key] = (left - taken, now)
        if len(self._buckets) > MAX_BUCKETS:
            self._buckets.popitem(last=False)
        return taken
