"""Convex solids: boxes, cylinders, spheres, capsules and hulls of points, with volume, centre and extent."""

from __future__ import annotations

from math import pi, sqrt
from typing import Literal, TypeAlias, assert_never

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose

Size: TypeAlias = tuple[float, float, float]
Kind: TypeAlias = Literal["box", "cylinder", "sphere", "capsule", "hull"]


class Hull(msgspec.Struct, frozen=True, eq=False):
    """The convex hull of points (n, 3) m; the volume in m^3 and the centre (3,) in m are those of what fills it."""

    points: Array
    volume: float
    centre: Array


class Solid(msgspec.Struct, frozen=True, eq=False):
    """A convex piece: half the size (3,) m of its own bounding box, and its pose in the frame of what it belongs to.

    Cylinders and capsules are along z; half of a capsule's length includes its end. `hull`: the points of a hull, in
    the frame of the piece.
    """

    kind: Kind
    half: Size
    place: Pose
    hull: Hull | None = None

    @property
    def volume(self) -> float:
        """The volume in m^3."""
        x, y, z = self.half
        match self.kind:
            case "box":
                return 8 * x * y * z
            case "cylinder":
                return 2 * pi * x * x * z
            case "sphere":
                return 4 / 3 * pi * x**3
            case "capsule":
                return 2 * pi * x * x * (z - x) + 4 / 3 * pi * x**3
            case "hull":
                return self.of_hull.volume
            case _:
                assert_never(self.kind)

    @property
    def centre(self) -> Array:
        """The centre of mass (3,) in m in the frame of what it belongs to."""
        return self.place.position if self.hull is None else self.place.apply(self.hull.centre)

    @property
    def of_hull(self) -> Hull:
        """The points of a hull; ValueError for any other kind."""
        if self.hull is None:
            raise ValueError(f"a {self.kind} has no points")
        return self.hull

    def reach(self, direction: Array, frame: Pose) -> float:
        """Return how far the solid reaches along a unit vector `direction` (3,), in m from the origin.

        The greatest d . x of all points x of the solid: its support function. frame: pose of its owner.
        """
        place = frame @ self.place
        along, (x, _, z) = place.rotation.T @ direction, self.half
        middle, upright = float(direction @ place.position), abs(float(along[2]))
        match self.kind:
            case "box":
                return middle + float(np.abs(along) @ self.half)
            case "cylinder":
                return middle + upright * z + x * sqrt(max(0.0, 1.0 - upright * upright))
            case "sphere":
                return middle + x
            case "capsule":
                return middle + upright * (z - x) + x
            case "hull":
                return middle + float((self.of_hull.points @ along).max())
            case _:
                assert_never(self.kind)


def block(size: tuple[float, ...], middle: tuple[float, ...] = (0.0, 0.0, 0.0), kind: Kind = "box") -> Solid:
    """Return a solid that fills a box of size (3,) m with its middle at a place (3,) in m."""
    x, y, z = size
    return Solid(kind, (x / 2, y / 2, z / 2), Pose(np.array(middle), np.eye(3)))


def centre_of(solids: tuple[Solid, ...]) -> Array:
    """Return the centre of mass (3,) in m of solids of one material, in their frame."""
    volumes = np.array([each.volume for each in solids])
    return np.asarray(volumes @ np.array([each.centre for each in solids]) / volumes.sum())
