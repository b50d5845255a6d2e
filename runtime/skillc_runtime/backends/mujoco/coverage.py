"""Which parts of a surface were worked on: cells of 5 mm that a tool reached while it was pressed on the surface."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.arrays import Matrix, OutMatrix, Vector
from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.numerics.linear import add_under, product, times
from skillc_runtime.motion.pose import Array, Pose

CELL_M = 0.005
"""Edge of a cell."""

TOUCHES_M = 1e-4
"""How far above a cell the face of a tool that does not yield may be and still touches it."""

NEAR_PLANE_M = 0.03
"""How far from a surface's plane a pressed tool may be to work on it: a tilted tool's middle is a little off."""


class CoverageMap:
    """The contact time of every cell of one surface: `dose` (rows along y, columns along x) in s; 0 is unwiped.

    `surface` is the true frame in the middle of the surface; `layout` says which cells count. A tool that is pressed on
    the surface with less than `least_n` does nothing to it.
    """

    def __init__(self, surface: Pose, layout: Layout, least_n: float) -> None:
        self.least_n, self.normal = least_n, surface.rotation[:, 2]
        self._in_surface = surface.inverse()
        self.x, self.y = _centres(float(layout.size[0])), _centres(float(layout.size[1]))
        self.mask = layout.work_mask(self.x, self.y)
        self.dose: NDArray[np.float64] = np.zeros((self.y.size, self.x.size))

    @property
    def wiped_share(self) -> float:
        """The share of the cells that count that were wiped."""
        return self.rubbed_share(0.0)

    def rubbed_share(self, seconds: float) -> float:
        """Return the share of the cells that count that were wiped, and for so long at least; 1 where none counts."""
        dose = self.dose[self.mask]
        return float(((dose > 0) & (dose >= seconds)).mean()) if dose.size else 1.0

    def add(self, position: Array, rotation: Array, tool: Array, seconds: float) -> None:
        """Count, for some seconds, the cells that a tool's working face reaches.

        position (3,), rotation (3, 3): the middle of the face in the world, x and y along its edges, as if it did not
        yield: pressed it lies below the surface, and tilted one side of it above. tool (2,): its size in m.
        """
        frame = self._in_surface
        add_dose(self.dose, self.x, self.y, frame.position, frame.rotation, position, rotation, tool, seconds)

    def near(self, position: Array, reach_m: float) -> bool:
        """Whether a point of the world is close to this surface's plane, over it or within `reach_m` of its edge."""
        point = self._in_surface.apply(position)
        over = abs(point[0]) <= self.x[-1] + reach_m and abs(point[1]) <= self.y[-1] + reach_m
        return bool(over and abs(point[2]) <= NEAR_PLANE_M)


def _centres(length: float) -> Array:
    """Return the middles of the cells along an edge in m, symmetric to 0; the cells fill the edge evenly."""
    count = max(1, round(length / CELL_M))
    return np.asarray((np.arange(count) + 0.5) * (length / count) - length / 2, dtype=np.float64)


@compiled
def add_dose(
    dose: OutMatrix,
    x: Vector,
    y: Vector,
    origin: Vector,
    turn: Matrix,
    position: Vector,
    rotation: Matrix,
    tool: Vector,
    seconds: float,
) -> None:
    """Add to the dose of cells in columns x and rows y; origin and turn are the world's pose in the surface."""
    middle, axes = np.empty(3), np.empty((3, 3))
    times(turn, position, middle)
    for i in range(3):
        middle[i] += origin[i]
    product(turn, rotation, axes)
    add_under(dose, x, y, middle, axes, tool, seconds, TOUCHES_M)


class SimulatedCamera:
    """Implements `Camera` from the coverage of each surface by IRI, which the running cell keeps up to date."""

    def __init__(self, coverage: Mapping[str, CoverageMap]) -> None:
        self._coverage = coverage

    def inspect(self, surface: str) -> float:
        """Return the share of the surface that is wiped; KeyError for a surface that is not there."""
        return self._coverage[surface].wiped_share

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share that was under a pressed tool for so long; KeyError for a surface that is not there."""
        return self._coverage[surface].rubbed_share(seconds)
