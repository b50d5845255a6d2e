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

PART_PLACES: Final = tuple((x, y) for y in (-0.1, -0.23, -0.36, -0.48) for x in (0.38, 0.48, 0.58))
BIN_PLACES: Final = tuple((x, y) for y in (0.14, 0.31, 0.48) for x in (0.40, 0.57))
"""Places on the table in m in front of the arm: fingers around a thing at one of them are clear of the next."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part: its shape, size (3,) in m, mass in kg and the position (3,) of its middle in m in the world."""

    name: str
    shape: ShapeName
    size: Point
    mass_kg: float
    at: Point
    roll_deg: float = 0.0
    friction: float = 0.6


@dataclass(frozen=True, slots=True)
class Bin:
    """A bin: its size (3,) in m, None for a place without a body, and the position of its middle in m in the world."""

    name: str
    size: Point | None
    at: Point


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell: an arm, parts, bins, other boxes by size and position, what is to be put where, what is in what."""

    arm: ArmName
    parts: tuple[Part, ...]
    bins: tuple[Bin, ...]
    goal: tuple[tuple[str, str], ...]
    boxes: tuple[tuple[str, Point, Point], ...] = ()
    contained: tuple[tuple[str, str], ...] = ()


def draw_cell(rng: Random, most_bins: int = 6) -> Cell:
    """Draw a cell that can be solved; each bin gets at most one part, further parts stay where they are."""
    arm: ArmName = rng.choice(("iiwa14", "ur5e", "panda"))
    count, bins = rng.randint(1, 12), rng.randint(1, most_bins)
    parts = tuple(_draw_part(rng, n, at, SHAPES[arm]) for n, at in enumerate(rng.sample(PART_PLACES, count), 1))
    places = enumerate(rng.sample(BIN_PLACES, bins), 1)
    drawn = tuple(_draw_bin(rng, n, at) for n, at in places)
    goal = tuple((part.name, bin_.name) for part, bin_ in zip(parts, drawn, strict=False))
    return Cell(arm, parts, drawn, goal)


def _draw_part(rng: Random, number: int, place: tuple[float, float], shapes: tuple[ShapeName, ...]) -> Part:
    width = round(rng.uniform(0.026, 0.036), 4)
    shape: ShapeName = rng.choice(shapes)
    height = width if shape == "sphere" else round(rng.uniform(0.05, 0.07), 4)
    length = round(1.5 * width, 4) if shape == "bar" else width
    x, y = _near(rng, place)
    mass = round(rng.uniform(0.05, 0.25), 3)
    return Part(f"Part-{number}", shape, (length, width, height), mass, (x, y, TABLE_M + height / 2))


def _draw_bin(rng: Random, number: int, place: tuple[float, float]) -> Bin:
    side, height = round(rng.uniform(0.145, 0.155), 3), round(rng.uniform(0.035, 0.05), 3)
    x, y = _near(rng, place)
    return Bin(f"Bin-{number}", (side, side, height), (x, y, TABLE_M + height / 2))


def _near(rng: Random, place: tuple[float, float]) -> tuple[float, float]:
    x, y = (round(each + rng.uniform(-JITTER_M, JITTER_M), 4) for each in place)
    return x, y
