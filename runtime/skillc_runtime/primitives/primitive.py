"""The life cycle of a primitive skill and what it may touch."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell


class Status(Enum):
    """The state of a node or a primitive."""

    IDLE = "idle"
    RUNNING = "running"
    SUCCESS = "success"
    FAILURE = "failure"
    HALTED = "halted"


class SkillFailure(Exception):
    """A primitive cannot do what was asked; the message tells the user why, with numbers."""


class Primitive:
    """One run of a primitive skill: made with its bound arguments when it starts, never used twice.

    A subclass takes the cell and its parameters by name: `__init__(self, cell, *, arm: str, speed: float)`.
    Individuals come as IRIs, quantities in SI units, unset optional parameters as None. Any method may raise
    SkillFailure; from `start` it means that another implementation may be tried.
    """

    def __init__(self, cell: Cell) -> None:
        self.cell = cell
        self.outputs: dict[str, object] = {}

    def start(self) -> None:
        """Begin; nothing may have moved when this raises."""

    def tick(self) -> Status:
        """Go on for one tick and return RUNNING or SUCCESS."""
        raise NotImplementedError

    def halt(self, reason: str) -> None:
        """Stop safely at once. Called exactly once, also after an error, unless `start` refused or `tick` succeeded."""

    def pause(self) -> None:
        """Hold still until `resume`."""

    def resume(self) -> None:
        """Go on after `pause`."""

    def release(self) -> None:
        """Undo what a scoped skill set up; called once when its scope ends, however it ends."""
