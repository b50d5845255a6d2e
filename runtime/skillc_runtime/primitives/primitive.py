"""The life cycle of a primitive skill and what it may touch."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


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

    `text_names` says which texts name something, so that a misspelt one is reported before anything runs: a parameter
    with the parameter to start from, the relations to follow and the property whose values are the names, as IRIs.
    """

    text_names: ClassVar[Mapping[str, tuple[str, ...]]] = MappingProxyType({})

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
