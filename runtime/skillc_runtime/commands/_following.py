"""Following, during a run, what other processes write to the store."""

from __future__ import annotations

import time
from collections.abc import Callable

from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError

PERIOD_S = 0.2
"""How often a store is asked, by the clock: a server takes a millisecond or more to answer."""


class Follower:
    """Asks a world model to follow its store; a store that cannot be read is told once, and asked again."""

    def __init__(self, world: WorldModel, tell: Callable[[str], None]) -> None:
        self._world, self._tell = world, tell
        self._next, self._told = 0.0, ""

    def __call__(self) -> None:
        """Follow, if it is time."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + PERIOD_S
        try:
            self._world.follow()
            self._told = ""
        except StoreError as error:
            if str(error) != self._told:
                self._told = str(error)
                self._tell(f"warning: {error}")
