"""What inspects surfaces, and buttons: sensors of a cell, simulated or real."""

from __future__ import annotations

from typing import Protocol


class Camera(Protocol):
    """Looks at surfaces."""

    def inspect(self, surface: str) -> float:
        """Return the share of a surface, given by IRI, that is clean; KeyError for a surface that is not there."""
        ...

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share that was rubbed for so long at least; KeyError for a surface that is not there."""
        ...


class Button(Protocol):
    """A button that somebody else reads, too: a machine starts when it switches."""

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far in that it has switched."""
        ...
