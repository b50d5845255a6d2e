"""The seam to a button, simulated or wired to an input."""

from __future__ import annotations

from typing import Protocol


class Button(Protocol):
    """A button that somebody else reads, too: a machine starts when it switches."""

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far in that it has switched."""
        ...
