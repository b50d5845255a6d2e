"""Shapes of bodies and the convex solids that they are made of, around the middle of their bounding box."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Literal, TypeAlias, assert_never

import numpy as np

from skillc_runtime.motion.pose import Array, Pose

Size: TypeAlias = tuple[float, float, float]
Kind: TypeAlias = Literal["box", "cylinder", "sphere", "capsule"]

ROUND_M = 1e-6
"""The diameters of what is round may differ by this much."""


class ShapeError(ValueError):
    """A size that a shape cannot have; the message says what is wrong with it, and what the shape needs."""


@dataclass(frozen=True, slots=True)
class Box:
    """A box of size (3,) m."""

    size: Size


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A cylinder along z in a box of size (3,) m."""

    size: Size


@dataclass(frozen=True, slots=True)
class Sphere:
    """A sphere in a box of size (3,) m."""

    size: Size


@dataclass(frozen=True, slots=True)
class Capsule:
    """A cylinder along z with half spheres as its ends, in a box of size (3,) m."""

    size: Size


@dataclass(frozen=True, slots=True)
class Bin:
    """A floor and four walls of thickness `wall_m`, open at the top, in a box of size (3,) m."""

    size: Size
    wall_m: float

    @property
    def inside(self) -> Size:
        """The size (3,) in m of the room inside, which touches the top of the bin."""
        x, y, z = self.size
        return x - 2 * self.wall_m, y - 2 * self.wall_m, z - self.wall_m


Shape: TypeAlias = Box | Cylinder | Sphere | Capsule | Bin


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """A convex piece: half the size (3,) m of its own bounding box, and its pose in the frame of what it belongs to.

    Cylinders and capsules are along z; half of a capsule's length includes its end.
    """

    kind: Kind
    half: Size
    place: Pose

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
            case _:
                assert_never(self.kind)


def solids_of(shape: Shape) -> tuple[Solid, ...]:
    """Return the solids of a shape in the frame at the middle of its box; ShapeError if its size is impossible."""
    match shape:
        case Box():
            return (_solid("box", shape.size),)
        case Cylinder():
            _check_round("cylinder", shape.size[:2])
            return (_solid("cylinder", shape.size),)
        case Sphere():
            _check_round("sphere", shape.size)
            return (_solid("sphere", shape.size),)
        case Capsule():
            return (_capsule(shape.size),)
        case Bin():
            return _bin(shape)
        case _:
            assert_never(shape)


def centre_of(solids: tuple[Solid, ...]) -> Array:
    """Return the centre of mass (3,) in m of solids of one material, in their frame."""
    volumes = np.array([each.volume for each in solids])
    return np.asarray(volumes @ np.array([each.place.position for each in solids]) / volumes.sum())


def _solid(kind: Kind, size: tuple[float, ...], middle: tuple[float, ...] = (0.0, 0.0, 0.0)) -> Solid:
    x, y, z = size
    return Solid(kind, (x / 2, y / 2, z / 2), Pose(np.array(middle), np.eye(3)))


def _check_round(kind: str, sizes: tuple[float, ...]) -> None:
    if max(sizes) - min(sizes) > ROUND_M:
        names = " and ".join(("SizeX", "SizeY", "SizeZ")[: len(sizes)])
        found = " x ".join(f"{each:g}" for each in sizes)
        raise ShapeError(f"is {found} m, but {names} of a {kind} are its diameter, so they must be equal")


def _capsule(size: Size) -> Solid:
    _check_round("capsule", size[:2])
    if size[2] < size[0] - ROUND_M:
        raise ShapeError(f"is {size[2]:g} m long, but a capsule is at least as long as its diameter of {size[0]:g} m")
    return _solid("capsule", size)


def _bin(shape: Bin) -> tuple[Solid, ...]:
    """Return the floor, then the walls along y at both ends of x, then those along x between them."""
    (x, y, z), wall, (inside_x, inside_y, inside_z) = shape.size, shape.wall_m, shape.inside
    if min(inside_x, inside_y, inside_z) <= 0:
        raise ShapeError(f"is {x:g} x {y:g} x {z:g} m with walls of {wall:g} m, so there is no room inside")
    floor = _solid("box", (x, y, wall), (0.0, 0.0, (wall - z) / 2))
    long = [_solid("box", (wall, y, inside_z), (side * (x - wall) / 2, 0.0, wall / 2)) for side in (-1, 1)]
    short = [_solid("box", (inside_x, wall, inside_z), (0.0, side * (y - wall) / 2, wall / 2)) for side in (-1, 1)]
    return (floor, *long, *short)
