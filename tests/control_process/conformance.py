"""The toy robot as one of the back ends of the conformance suite."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from functools import partial

from backends.backend import MakeBackend
from backends.remote import CONFORMANCE, RemoteBackend
from control_process.toy_link import Toy, toy_cell
from simulation.cells import ARM
from skillc_runtime.motion.pose import Array


class ToySurroundings:
    """Implements `Surroundings`."""

    def __init__(self, toy: Toy) -> None:
        self._toy, self.home = toy, toy.ask("home")

    def put_wall(self, gap_m: float) -> Array:
        normal: Array = self._toy.ask("put_wall", gap_m)
        return normal

    def remove_wall(self) -> None:
        self._toy.ask("remove_wall")

    def wall_force_n(self) -> float:
        return float(self._toy.ask("wall_force_n"))

    def violations(self) -> Sequence[str]:
        found: list[str] = self._toy.ask("report")["violations"]
        return found


def open_toy(scene: str, opened: ExitStack) -> MakeBackend:
    """Start the robot of a scene and open its cell."""
    toy, cell = opened.enter_context(toy_cell(scene, patience=CONFORMANCE))
    return partial(RemoteBackend, cell, ARM[scene], ToySurroundings(toy))
