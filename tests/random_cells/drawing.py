"""Draws cells from a known solution: every part and every bin is reachable, supported and free, with margins."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random
from typing import Final, Literal, TypeAlias

ArmName: TypeAlias = Literal["iiwa14", "ur5e", "panda"]
ShapeName: TypeAlias = Literal["box", "bar", "cylinder", "sphere"]
Point: TypeAlias = tuple[float, float, float]

TABLE_M: Final = 0.6
"""The height of the table and of the pedestal of the arm."""

SHAPES: Final[dict[ArmName, tuple[ShapeName, ...]]] = {
    "iiwa14": ("box", "bar"),
    "ur5e": ("box", "bar", "cylinder", "sphere"),
    "panda": ("box", "bar", "cylinder", "sphere"),
}
"""What each arm's gripper can hold: two of three fingers side by side stand closer together on what is round."""

JITTER_M = 0.005

PART_PLACES: Final = (
    *((x, y) for y in (-0.1, -0.23, -0.36) for x in (0.43, 0.53, 0.63)),
    *((x, -0.48) for x in (0.33, 0.43, 0.53)),
)
"""Places on the table in m in front of the arm: fingers around a thing at one of them are clear of the next."""

WIDE_PLACES: Final = (*((x, y) for y in (-0.12, -0.27) for x in (0.46, 0.60)), (0.36, -0.42), (0.50, -0.42))
"""The same for things that really lie up to ELSEWHERE_M and ELSEWHERE_RAD from there."""

ELSEWHERE_M, ELSEWHERE_RAD = 0.02, 0.26

BIN_PLACES: Final[tuple[tuple[int, tuple[float, float], tuple[tuple[float, float], ...]], ...]] = (
    (8, (0.30, 0.36), ((0.52, 0.26),)),
    (4, (0.30, 0.22), ((0.53, 0.19), (0.45, 0.45))),
    (2, (0.155, 0.23), ((0.47, 0.19), (0.64, 0.19), (0.35, 0.45), (0.52, 0.45))),
    (1, (0.145, 0.145), ((0.45, 0.14), (0.61, 0.14), (0.45, 0.31), (0.61, 0.31), (0.32, 0.48), (0.48, 0.48))),
)
"""How many parts each bin takes with margins, its length and width in m, and places for so large bins."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part: its shape, size (3,) in m, mass in kg and the position (3,) of its middle in m in the world."""

    name: str
    shape: ShapeName
    size: Point
    mass_kg: float
    at: Point
    roll_deg: float = 0.0
    yaw_deg: float = 0.0
    friction: float = 0.6


@dataclass(frozen=True, slots=True)
class Bin:
    """A bin: its size (3,) in m, None for a place without a body, and the position of its middle in m in the world."""

    name: str
    size: Point | None
    at: Point


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell: an arm, parts, bins, other boxes by size and position, what is to be put where, what is in what.

    If it has a camera, the parts really lie somewhere near the places where the scene says.
    """

    arm: ArmName
    parts: tuple[Part, ...]
    bins: tuple[Bin, ...]
    goal: tuple[tuple[str, str], ...]
    boxes: tuple[tuple[str, Point, Point], ...] = ()
    contained: tuple[tuple[str, str], ...] = ()
    has_camera: bool = False


def draw_cell(rng: Random, most_parts: int = 12) -> Cell:
    """Draw a cell that can be solved; at most `most_parts` parts are to be put into bins, the others stay."""
    arm: ArmName = rng.choice(("iiwa14", "ur5e", "panda"))
    has_camera = rng.random() < 0.5
    places = WIDE_PLACES if has_camera else PART_PLACES
    count, bins = rng.randint(1, len(places)), rng.randint(1, 6)
    parts = tuple(_draw_part(rng, n, at, SHAPES[arm]) for n, at in enumerate(rng.sample(places, count), 1))
    room, size, corners = next(each for each in BIN_PLACES if bins <= len(each[2]))
    drawn = tuple(_draw_bin(rng, n, size, at) for n, at in enumerate(rng.sample(corners, bins), 1))
    slots = [each.name for each in drawn for _ in range(room)]
    moved = min(count, most_parts)
    goal = tuple(zip((part.name for part in parts[:moved]), rng.sample(slots, len(slots)), strict=False))
    return Cell(arm, parts, drawn, goal, has_camera=has_camera)


def _draw_part(rng: Random, number: int, place: tuple[float, float], shapes: tuple[ShapeName, ...]) -> Part:
    width = round(rng.uniform(0.026, 0.036), 4)
    shape: ShapeName = rng.choice(shapes)
    height = width if shape == "sphere" else round(rng.uniform(0.05, 0.07), 4)
    length = round(1.5 * width, 4) if shape == "bar" else width
    x, y = _near(rng, place)
    mass = round(rng.uniform(0.05, 0.25), 3)
    yaw = round(rng.choice((0.0, rng.uniform(-20.0, 20.0))), 1)
    return Part(f"Part-{number}", shape, (length, width, height), mass, (x, y, TABLE_M + height / 2), yaw_deg=yaw)


def _draw_bin(rng: Random, number: int, size: tuple[float, float], place: tuple[float, float]) -> Bin:
    (length, width), height = size, round(rng.uniform(0.035, 0.05), 3)
    x, y = _near(rng, place)
    return Bin(f"Bin-{number}", (length, width, height), (x, y, TABLE_M + height / 2))


def _near(rng: Random, place: tuple[float, float]) -> tuple[float, float]:
    x, y = (round(each + rng.uniform(-JITTER_M, JITTER_M), 4) for each in place)
    return x, y
