"""Shapes of bodies and the convex solids that they are made of, around the middle of their bounding box."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TypeAlias, assert_never

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.world.space.shape.solids import Hull, Kind, Size, Solid, block

BIN_WALL_M, SHELF_WALL_M, TABLE_WALL_M = 0.004, 0.018, 0.03
"""The thickness of walls and boards that is not stated."""

SHELF_BOARDS = 3
"""The number of boards of a shelf that states none."""

ROUND_M = 1e-6
"""The diameters of what is round may differ by this much."""

LEG_SHARE = 2.0
"""How much thicker the legs of a table are than its board."""


class ShapeError(ValueError):
    """A size that a shape cannot have; the message says what is wrong with it, and what the shape needs."""


class Box(msgspec.Struct, frozen=True):
    """A box of size (3,) m."""

    size: Size


class Cylinder(msgspec.Struct, frozen=True):
    """A cylinder along z in a box of size (3,) m."""

    size: Size


class Sphere(msgspec.Struct, frozen=True):
    """A sphere in a box of size (3,) m."""

    size: Size


class Capsule(msgspec.Struct, frozen=True):
    """A cylinder along z with half spheres as its ends, in a box of size (3,) m."""

    size: Size


class Bin(msgspec.Struct, frozen=True):
    """A floor and four walls of thickness `wall_m`, open at the top, in a box of size (3,) m."""

    size: Size
    wall_m: float

    @property
    def inside(self) -> Size:
        """The size (3,) in m of the room inside, which touches the top of the bin."""
        x, y, z = self.size
        return x - 2 * self.wall_m, y - 2 * self.wall_m, z - self.wall_m


class Shelf(msgspec.Struct, frozen=True):
    """Boards of thickness `wall_m` between two sides and a back, open towards -y, in a box of size (3,) m."""

    size: Size
    wall_m: float
    boards: int


class Table(msgspec.Struct, frozen=True):
    """A board of thickness `wall_m` on four legs, in a box of size (3,) m."""

    size: Size
    wall_m: float


class Panel(msgspec.Struct, frozen=True):
    """A box of size (3,) m with rectangles (x, y, width, depth) in m, of their middles, cut through it along z."""

    size: Size
    openings: tuple[tuple[float, float, float, float], ...]


class Mesh(msgspec.Struct, frozen=True, eq=False):
    """Convex pieces of a mesh in a box of size (3,) m; `whole` if they are the hull of all of it."""

    size: Size
    pieces: tuple[Hull, ...]
    whole: bool


Shape: TypeAlias = Box | Cylinder | Sphere | Capsule | Bin | Shelf | Table | Panel | Mesh


def solids_of(shape: Shape) -> tuple[Solid, ...]:
    """Return the solids of a shape in the frame at the middle of its box; ShapeError if its size is impossible."""
    match shape:
        case Box():
            return (block(shape.size),)
        case Cylinder():
            return (_round("cylinder", shape.size, 2),)
        case Sphere():
            return (_round("sphere", shape.size, 3),)
        case Capsule():
            return (_capsule(shape.size),)
        case Bin():
            return _bin(shape)
        case Shelf():
            return _shelf(shape)
        case Table():
            return _table(shape)
        case Panel():
            return _panel(shape)
        case Mesh():
            middle = block(shape.size)
            return tuple(Solid("hull", _half(each), middle.place, each) for each in shape.pieces)
        case _:
            assert_never(shape)


def _half(hull: Hull) -> Size:
    x, y, z = np.abs(hull.points).max(axis=0).tolist()
    return x, y, z


def _round(kind: Kind, size: Size, equal: int) -> Solid:
    sizes = size[:equal]
    if max(sizes) - min(sizes) > ROUND_M:
        names = ("SizeX and SizeY", "SizeX, SizeY and SizeZ")[equal - 2]
        found = " x ".join(f"{each:g}" for each in sizes)
        raise ShapeError(f"is {found} m, but {names} of a {kind} are its diameter, so they must be equal")
    return block(size, kind=kind)


def _capsule(size: Size) -> Solid:
    solid = _round("capsule", size, 2)
    if size[2] < size[0] - ROUND_M:
        raise ShapeError(f"is {size[2]:g} m long, but a capsule is at least as long as its diameter of {size[0]:g} m")
    return block(size, kind="sphere") if size[2] < size[0] + ROUND_M else solid


def _bin(shape: Bin) -> tuple[Solid, ...]:
    """Return the floor, then the walls along y at both ends of x, then those along x between them."""
    (x, y, z), wall, (inside_x, inside_y, inside_z) = shape.size, shape.wall_m, shape.inside
    if min(inside_x, inside_y, inside_z) <= 0:
        raise ShapeError(f"is {x:g} x {y:g} x {z:g} m with walls of {wall:g} m, so there is no room inside")
    floor = block((x, y, wall), (0.0, 0.0, (wall - z) / 2))
    long = [block((wall, y, inside_z), (side * (x - wall) / 2, 0.0, wall / 2)) for side in (-1, 1)]
    short = [block((inside_x, wall, inside_z), (0.0, side * (y - wall) / 2, wall / 2)) for side in (-1, 1)]
    return (floor, *long, *short)


def _shelf(shape: Shelf) -> tuple[Solid, ...]:
    """Return the boards from the bottom to the top, then the sides at both ends of x, then the back at +y."""
    (x, y, z), wall = shape.size, shape.wall_m
    if shape.boards < 2 or shape.boards * wall >= z or 2 * wall >= x or wall >= y:
        raise ShapeError(
            f"is {x:g} x {y:g} x {z:g} m with {shape.boards} boards of {wall:g} m; a shelf has room between two"
        )
    heights = np.linspace((wall - z) / 2, (z - wall) / 2, shape.boards).tolist()
    boards = [block((x - 2 * wall, y - wall, wall), (0.0, -wall / 2, height)) for height in heights]
    sides = [block((wall, y - wall, z), (side * (x - wall) / 2, -wall / 2, 0.0)) for side in (-1, 1)]
    return (*boards, *sides, block((x, wall, z), (0.0, (y - wall) / 2, 0.0)))


def _table(shape: Table) -> tuple[Solid, ...]:
    """Return the board, then the four legs in its corners."""
    (x, y, z), wall = shape.size, shape.wall_m
    leg = LEG_SHARE * wall
    if wall >= z or 2 * leg >= min(x, y):
        raise ShapeError(f"is {x:g} x {y:g} x {z:g} m with a board of {wall:g} m; a table has room between its legs")
    board = block((x, y, wall), (0.0, 0.0, (z - wall) / 2))
    corners = product((-1, 1), (-1, 1))
    legs = [block((leg, leg, z - wall), (a * (x - leg) / 2, b * (y - leg) / 2, -wall / 2)) for a, b in corners]
    return (board, *legs)


def _panel(shape: Panel) -> tuple[Solid, ...]:
    """Return the boxes that remain: one for each piece of each strip along x between edges of openings along y."""
    x, y, z = shape.size
    found = []
    for low, high in pairwise(_edges(y, [(v, d) for _, v, _, d in shape.openings])):
        middle = (low + high) / 2
        cut = [(u, w) for u, v, w, d in shape.openings if abs(middle - v) < d / 2]
        for left, right in _between(x, cut):
            found.append(block((right - left, high - low, z), ((left + right) / 2, middle, 0.0)))
    if not found:
        raise ShapeError("has openings that leave nothing of it")
    return tuple(found)


def _edges(length: float, spans: list[tuple[float, float]]) -> list[float]:
    """Return the ends of spans (middle, length) within a length, and its own, ascending."""
    half = length / 2
    ends = {min(max(end, -half), half) for middle, span in spans for end in (middle - span / 2, middle + span / 2)}
    return sorted({-half, half, *ends})


def _between(length: float, spans: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return what spans (middle, length) leave of a length, as pairs of ends."""
    half, at, left = length / 2, -length / 2, []
    for middle, span in sorted(spans, key=lambda each: each[0] - each[1] / 2):
        if middle - span / 2 > at:
            left.append((at, min(middle - span / 2, half)))
        at = max(at, middle + span / 2)
    return [*left, (at, half)] if at < half else left
