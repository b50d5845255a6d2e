"""The coverage of a surface: cells of 5 mm that a tool reached while it was pressed on the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.arrays import Matrix, OutMatrix, Vector
from skillc_runtime.motion.dirt_map import CLEAN, DirtMap, resample
from skillc_runtime.motion.layout import Layout
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import add_under, product, times
from skillc_runtime.motion.pose import Array, Pose

CELL_M = 0.005
"""Edge of a cell."""

TOUCHES_M = 1e-4
"""Height of a point of a rigid tool face above a cell up to which it touches the cell."""

NEAR_PLANE_M = 0.03
"""Distance of the centre of a pressed tool from the surface's plane up to which it works; it may be tilted."""


class CoverageMap:
    """The contact time of every cell of one surface: `dose` (rows along y, columns along x) in s; 0 is unwiped.

    `surface` is the true frame at the centre of the surface in the world, `world` the world in the surface; `layout`
    gives the cells that count, and the size (2,) in m of all of them. A tool works if it is pressed on the surface with
    at least `least_n` N. `clean` says which cells have been clean before: all that a map of dirt knows to be clean.
    """

    def __init__(self, surface: Pose, layout: Layout, least_n: float, dirt: DirtMap | None = None) -> None:
        self.least_n, self.normal = least_n, surface.rotation[:, 2].copy()
        self.world, self.size = surface.inverse(), layout.size
        self.x, self.y = _centres(float(layout.size[0])), _centres(float(layout.size[1]))
        self.mask = layout.work_mask(self.x, self.y)
        self.dose: NDArray[np.float64] = np.zeros((self.y.size, self.x.size))
        self.clean: NDArray[np.bool_] = np.zeros(self.dose.shape, dtype=bool)
        if dirt is not None:
            self.clean[:] = resample(dirt, self.x, self.y, layout.size) == CLEAN

    @property
    def wiped_share(self) -> float:
        """The share of the counted cells that are clean: they were wiped, or have been clean before."""
        clean = self.find_clean()
        return float(clean.mean()) if clean.size else 1.0

    def rubbed_share(self, seconds: float) -> float:
        """Return the share of the counted cells that were wiped for at least `seconds`; 1 if no cell counts."""
        worked = self.find_worked(seconds)
        return float(worked.mean()) if worked.size else 1.0

    def find_worked(self, seconds: float) -> NDArray[np.bool_]:
        """Return which of the counted cells (n,) were wiped for at least `seconds`."""
        dose = self.dose[self.mask]
        return np.asarray((dose > 0) & (dose >= seconds))

    def find_clean(self) -> NDArray[np.bool_]:
        """Return which of the counted cells (n,) were wiped, or have been clean before."""
        return np.asarray(self.find_worked(0.0) | self.clean[self.mask])

    def find_dirt(self, removal_s: float) -> Array:
        """Return the amounts (rows, columns) of dirt that are left: 1 at first, falling to 1/e in each `removal_s`."""
        return np.where(self.clean, 0.0, np.exp(-self.dose / removal_s))

    def find_under(self, position: Array, rotation: Array, tool: Array) -> NDArray[np.bool_]:
        """Return which cells (rows, columns) have their centre under a tool's working face; none if it is not near.

        position: (3,) in m, the centre of the face in the world.
        rotation: (3, 3), rotation (3, 3) of the face in the world; x and y are along its edges.
        tool: (2,) in m, its size.
        """
        middle, axes = self.world.apply(position), self.world.rotation @ rotation
        if abs(middle[2]) > NEAR_PLANE_M:
            return np.zeros(self.dose.shape, dtype=bool)
        x, y = self.x[None, :] - middle[0], self.y[:, None] - middle[1]
        inside = [np.abs(axes[0, side] * x + axes[1, side] * y) <= tool[side] / 2 for side in (0, 1)]
        return np.asarray(inside[0] & inside[1])

    def add(self, position: Array, rotation: Array, tool: Array, seconds: float) -> None:
        """Add a time to the cells that a tool's working face reaches.

        It is below the surface when pressed, with one side above if tilted.
        position: (3,) in m, the centre of the undeformed face in the world.
        rotation: (3, 3), rotation (3, 3) in the world; x and y are along the edges of the face.
        tool: (2,) in m, its size.
        seconds: s.
        """
        add_dose(self.dose, self.x, self.y, self.world, position, rotation, tool, seconds)


def _centres(length: float) -> Array:
    """Return the centres of the cells along an edge in m, symmetric to 0; the cells divide the edge evenly."""
    count = max(1, round(length / CELL_M))
    return np.asarray((np.arange(count) + 0.5) * (length / count) - length / 2, dtype=np.float64)


@inlined
def put_dose(
    dose: Array, x: Array, y: Array, world: Pose, position: Array, rotation: Array, tool: Array, seconds: float
) -> None:
    """Add to the dose of a surface under a tool.

    dose: (m, n) in s, a row for each y.
    x: (n,) in m, of the cells in the frame of the surface.
    y: (m,) in m, of the cells in the frame of the surface.
    world: pose of the world in the frame of the surface.
    position: (3,) in m, of the tool in the world.
    rotation: (3, 3), rotation (3, 3) of the tool in the world.
    tool: (2,) in m, its size.
    seconds: s, to be added.
    """
    middle, axes = np.empty(3), np.empty((3, 3))
    times(world.rotation, position, middle)
    for i in range(3):
        middle[i] += world.position[i]
    product(world.rotation, rotation, axes)
    add_under(dose, x, y, middle, axes, tool, seconds, TOUCHES_M)


@compiled
def add_dose(
    dose: OutMatrix,
    x: Vector,
    y: Vector,
    world: Pose,
    position: Vector,
    rotation: Matrix,
    tool: Vector,
    seconds: float,
) -> None:
    """Add a time to the dose of cells.

    dose: (m, n) in s, a row for each y.
    x: (n,) in m, of the columns.
    y: (m,) in m, of the rows.
    world: pose of the world in the frame of the surface.
    position: (3,) in m, of the tool in the world.
    rotation: (3, 3), rotation (3, 3) of the tool in the world, as in `CoverageMap.add`.
    tool: (2,) in m, its size.
    seconds: s, to be added.
    """
    put_dose(dose, x, y, world, position, rotation, tool, seconds)


@inlined
def is_near(x: Array, y: Array, world: Pose, position: Array, reach_m: float) -> bool:
    """Tell whether a point is near the surface's plane and its edge.

    x: (n,) in m, of the cells in the frame of the surface.
    y: (m,) in m, of the cells in the frame of the surface.
    world: pose of the world in the frame of the surface.
    position: (3,) in m, the point in the world.
    reach_m: m, how far outside of the edge it may be.
    """
    point = np.empty(3)
    times(world.rotation, position, point)
    for i in range(3):
        point[i] += world.position[i]
    if abs(point[0]) > x[x.size - 1] + reach_m or abs(point[1]) > y[y.size - 1] + reach_m:
        return False
    return bool(abs(point[2]) <= NEAR_PLANE_M)
