"""Solids that pictures show in addition to the model: a wall behind an upright surface, legs under a horizontal one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.shape.solids import Kind

UPRIGHT = 0.7
"""A surface is upright if the vertical component of its normal is smaller."""

LEG_M, WALL_M, BEHIND_M, AROUND_M = 0.03, 0.02, 0.03, 0.08
"""Thickness of legs and of a wall, gap between surface and wall, overhang of a wall beyond a surface."""

LEG_RGBA, WALL_RGBA = (0.45, 0.47, 0.5, 1.0), (0.72, 0.76, 0.8, 1.0)


@dataclass(frozen=True, slots=True)
class Prop:
    """A solid in the world: the pose of its centre, the size (3,) in m of its box, its colour, its shape."""

    pose: Pose
    size: Array
    rgba: tuple[float, float, float, float]
    kind: Kind = "box"


def make_props(surface: Pose, size: Array) -> tuple[Prop, ...]:
    """Return what supports a surface of size (3,) in m; its frame is at the centre of its face, z the normal."""
    lying = surface.rotation[2, 2] > UPRIGHT
    return tuple(_legs(surface, size) if lying else _wall(surface, size))


def _legs(surface: Pose, size: Array) -> Iterator[Prop]:
    """Yield a leg under each corner, down to the floor."""
    for side in product((-1, 1), (-1, 1)):
        corner = surface.apply(np.array([*(np.array(side) * (size[:2] - LEG_M) / 2), -size[2]]))
        if corner[2] > 0:
            middle = np.array([corner[0], corner[1], corner[2] / 2])
            yield Prop(Pose(middle, np.eye(3)), np.array([LEG_M, LEG_M, corner[2]]), LEG_RGBA)


def _wall(surface: Pose, size: Array) -> Iterator[Prop]:
    """Yield a wall that stands on the floor behind the surface."""
    out = surface.rotation[:, 2] * (1.0, 1.0, 0.0)
    out /= np.linalg.norm(out)
    along = np.cross([0.0, 0.0, 1.0], out)
    corners = np.array([surface.apply(np.array([x, y, 0.0]) * size / 2) for x, y in product((-1, 1), (-1, 1))])
    wide = float(np.ptp(corners @ along)) + 2 * AROUND_M
    high = float(corners[:, 2].max()) + AROUND_M
    middle = surface.position - (size[2] + BEHIND_M + WALL_M / 2) * out
    pose = Pose(
        np.array([middle[0], middle[1], high / 2]),
        np.column_stack([along, [0.0, 0.0, 1.0], np.cross(along, [0.0, 0.0, 1.0])]),
    )
    yield Prop(pose, np.array([wide, high, WALL_M]), WALL_RGBA)
