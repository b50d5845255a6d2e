"""Finds the part of a picture that can differ from the picture before it, so that only this part is drawn again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.film.camera import CameraView, Projection
from skillc_runtime.motion.pose import Array

WIDER, MARGIN_PIXELS = 1.3, 3
"""A sphere far from the middle of a picture is an ellipse; smooth edges and lines reach this far beyond."""

VALUES = 20
"""Position 3, orientation 9, size 3, colour 4 and type of a geom."""


@dataclass(frozen=True, slots=True)
class Window:
    """A part of a picture in pixels: columns from the left, rows from the bottom; the ends are not in it."""

    left: int
    bottom: int
    right: int
    top: int

    @property
    def pixels(self) -> tuple[slice, slice]:
        """The rows, from the bottom, and the columns."""
        return slice(self.bottom, self.top), slice(self.left, self.right)


@dataclass(frozen=True, slots=True)
class Spheres:
    """Spheres in the world: centres (n, 3) and radii (n,) in m."""

    centres: Array
    radii: Array

    def on_floor(self, direction: Array) -> Spheres:
        """Return spheres around the shadows on the floor (z = 0) in light with a direction (3,), downwards."""
        ways = np.maximum(self.centres[:, 2], 0.0) / -direction[2]
        return Spheres(self.centres + ways[:, np.newaxis] * direction, self.radii / -direction[2])


@dataclass(frozen=True, slots=True)
class DrawnGeoms:
    """What a scene draws: a sphere around each geom, and all that a renderer reads of it (n, VALUES)."""

    around: Spheres
    values: NDArray[np.float32]


def list_geoms(model: Any, scene: Any) -> DrawnGeoms:
    """Return the geoms of a scene of a model."""
    geoms = scene.geoms[: scene.ngeom]
    values = [(*each.pos, *each.mat.ravel(), *each.size, *each.rgba, each.type) for each in geoms]
    radii = [_radius(model, each) for each in geoms]
    rows = np.array(values, dtype=np.float32).reshape(len(geoms), VALUES)
    return DrawnGeoms(Spheres(rows[:, :3].astype(float), np.array(radii, dtype=float)), rows)


def _radius(model: Any, geom: Any) -> float:
    """Return the radius in m of a sphere around the place of a geom that has all of it."""
    if geom.objtype == mujoco.mjtObj.mjOBJ_GEOM:
        return float(model.geom_rbound[geom.objid])
    if geom.type == mujoco.mjtGeom.mjGEOM_LINE:  # its other sizes are in pixels
        return float(geom.size[2])
    return float(np.linalg.norm(geom.size))


def find_changes(before: DrawnGeoms, now: DrawnGeoms) -> Spheres:
    """Return spheres around what is drawn otherwise now, where it was and where it is."""
    both = min(len(before.values), len(now.values))
    same = (before.values[:both] == now.values[:both]).all(axis=1)
    parts = []
    for each in (before, now):
        changed = np.ones(len(each.values), dtype=bool)
        changed[:both] = ~same
        parts.append(Spheres(each.around.centres[changed], each.around.radii[changed]))
    return join_spheres(parts)


def join_spheres(parts: Sequence[Spheres]) -> Spheres:
    """Return all spheres of several parts."""
    return Spheres(np.concatenate([each.centres for each in parts]), np.concatenate([each.radii for each in parts]))


def find_window(spheres: Spheres, view: CameraView, projection: Projection) -> Window | None:
    """Return the window that has all spheres, as far as the picture goes; the whole picture for one at the camera.

    None if no pixel of the picture is in it.
    """
    whole = Window(0, 0, projection.width, projection.height)
    if not len(spheres.radii):
        return None
    right, up, depths = ((spheres.centres - view.position) @ view.axes.T).T
    if (depths <= 2.0 * spheres.radii).any():
        return whole
    pixels = projection.height / 2 / np.tan(np.radians(projection.fovy_deg) / 2) / depths
    reach = WIDER * spheres.radii * pixels + MARGIN_PIXELS
    columns, rows = projection.width / 2 + pixels * right, projection.height / 2 + pixels * up
    found = Window(
        max(0, int((columns - reach).min())),
        max(0, int((rows - reach).min())),
        min(whole.right, int((columns + reach).max()) + 1),
        min(whole.top, int((rows + reach).max()) + 1),
    )
    return found if found.left < found.right and found.bottom < found.top else None
