"""Stops of an operation, or of all that a cell does."""

from __future__ import annotations

import msgspec

MAX_REASON = 500


class StopReason(msgspec.Struct, frozen=True):
    """Why an operation, or everything, is stopped. A long reason is cut, and what else a body has is ignored."""

    reason: str = "stopped"

    @property
    def shown(self) -> str:
        """The reason as it is recorded."""
        return self.reason if len(self.reason) <= MAX_REASON else f"{self.reason[:MAX_REASON]} .."
