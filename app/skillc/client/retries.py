"""How long a server that was lost is looked for."""

from __future__ import annotations

import asyncio
import time

from skillc.client.errors import UnavailableError

FIRST_DELAY_S, MAX_DELAY_S = 0.1, 2.0
PATIENCE_S = 120.0
"""How long a server may be away before who waits for it gets an error, in s: it may be started again."""


class Retries:
    """Waits between attempts, longer each time, until a server was away for too long."""

    def __init__(self) -> None:
        self.succeeded()

    def succeeded(self) -> None:
        """The server is there."""
        self._delay_s, self._since = FIRST_DELAY_S, time.monotonic()

    async def wait(self, error: UnavailableError) -> None:
        """Wait before the next attempt; raise the error of the last one if the server was away for too long."""
        if time.monotonic() - self._since > PATIENCE_S:
            raise error
        await asyncio.sleep(self._delay_s)
        self._delay_s = min(2.0 * self._delay_s, MAX_DELAY_S)
