"""Where a thing of a scene is, and how large."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class PlacedThing:
    """A thing: name, classes, what its pose is stated relative to, pose in the world in m and degrees, size in m.

    `problem` says why its pose is not known; then position and angles are empty.
    """

    name: str
    classes: tuple[str, ...]
    stated: str
    position: tuple[float, ...]
    angles: tuple[float, ...]
    size: tuple[float, ...]
    problem: str | None = None
