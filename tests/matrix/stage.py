"""Primitives and functions that the cases run: they do what the name they are given says."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.primitives.primitive import Status
from skillc_runtime.world.state.world_state import WorldState
from tree.stage import Script, Scripted, Stage

SCRIPTS = {
    "fails": [Script("fail")],
    "slow": [Script(ticks=3)],
    "slower": [Script(ticks=5)],
    "fails late": [Script("fail", ticks=4)],
    "second": [Script("fail"), Script("success")],
}
"""What runs under these names do in turn; under any other name they succeed at once."""


class Does(Scripted):
    """Does what its name says, whatever else it is given."""

    def __init__(self, cell: Stage, *, name: str = "", **rest: object) -> None:
        super().__init__(cell, name=name, **rest)


class Measures(Does):
    """Finds a height of 0.3."""

    def tick(self) -> Status:
        status = super().tick()
        self.outputs["height"] = 0.3
        return status


def both(state: WorldState) -> list[str]:
    """A function of the vocabulary with a list as its result."""
    return ["first", "second of the list"]


def twice(state: WorldState, number: float) -> float:
    """A function of the vocabulary on numbers."""
    return 2 * number


def heading(state: WorldState, robot: str) -> NDArray[np.float64]:
    """A direction."""
    return np.array([0.0, 0.6, 0.8])


def several(state: WorldState, way: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """A list of vectors."""
    return [way, 2 * way]


def longest(state: WorldState, ways: tuple[NDArray[np.float64], ...]) -> NDArray[np.float64]:
    """A vector out of a list of them."""
    return max(ways, key=lambda way: float(np.linalg.norm(way)))
