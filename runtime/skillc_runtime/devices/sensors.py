"""Interfaces of the sensors of a cell, simulated or real: a camera and buttons."""

from __future__ import annotations

from typing import Protocol


class Camera(Protocol):
    """A camera that inspects surfaces."""

    def inspect(self, surface: str) -> float:
        """Return the share of a surface, by IRI, that is clean; KeyError if there is no such surface."""
        ...

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share of a surface that was rubbed for at least `seconds`.

        KeyError if there is no such surface.
        """
        ...


class Button(Protocol):
    """A button, for example one that starts a machine."""

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far that it has switched."""
        ...
