"""Follows what other processes write to the store of a world while a task runs."""

from __future__ import annotations

import time

from skillc.services.reporting.reporter import Reporter
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError

POLL_PERIOD_S = 0.2
"""How often a store is polled, in s of wall time: a server takes a millisecond or more to answer."""


class StorePoller:
    """Updates a world model with what other processes write to its store.

    A store that cannot be read is reported once and polled again later.
    """

    def __init__(self, world: WorldModel, reporter: Reporter) -> None:
        self._world, self._reporter = world, reporter
        self._next, self._reported = 0.0, ""

    def poll(self) -> None:
        """Update the world model if POLL_PERIOD_S has passed since the last time."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + POLL_PERIOD_S
        try:
            self._world.follow()
            self._reported = ""
        except StoreError as error:
            if str(error) != self._reported:
                self._reported = str(error)
                self._reporter.say(f"warning: {error}")
