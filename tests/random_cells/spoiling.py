"""Spoils a cell in one known way: in what the world model says, in reality, or while the task runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from random import Random
from typing import Literal, TypeAlias, assert_never, get_args

from random_cells.drawing import TABLE_M, Cell, Part, draw_cell
from random_cells.happening import DEEDS, Deed, Happening, draw_happening, draw_watched_cell

Fault: TypeAlias = Literal[
    "no support",
    "full bin",
    "slippery",
    "too wide",
    "too heavy",
    "displaced",
    "fallen over",
    "taken away",
    "blocked way",
]
Trouble: TypeAlias = Literal["none"] | Fault | Deed

FAULTS: tuple[Fault, ...] = get_args(Fault)

AWAY_M = (2.0, 2.0)
"""Where a part lies on the floor that somebody has taken away."""


@dataclass(frozen=True, slots=True)
class Case:
    """A cell as it is believed and as it is, and when a part is taken away; its trouble is with the last part.

    `happening` is what somebody does to that part while a camera looks.
    """

    seed: int
    trouble: Trouble
    believed: Cell
    real: Cell
    taken_at_s: float | None = None
    happening: Happening | None = None

    @property
    def victim(self) -> str:
        """The part that something is wrong with."""
        return self.believed.goal[-1][0]


def draw_case(seed: int, most_parts: int = 12) -> Case:
    """Draw the case of a seed: even seeds can be solved, in odd ones something is wrong, each kind in turn."""
    rng = Random(f"cells:{seed}")
    cell = draw_cell(rng, most_parts)
    if seed % 2 == 0:
        return Case(seed, "none", cell, cell)
    return _spoil(rng, seed, FAULTS[seed // 2 % len(FAULTS)], cell)


def draw_watched_case(seed: int, most_parts: int = 12) -> Case:
    """Draw the case of a seed in which something happens to a part while a camera looks, each kind in turn."""
    rng = Random(f"watched cells:{seed}")
    cell, deed = draw_watched_cell(rng, most_parts), DEEDS[seed % len(DEEDS)]
    return Case(seed, deed, cell, cell, happening=draw_happening(rng, deed))


SERIES: Mapping[str, Callable[[int, int], Case]] = {"spoilt": draw_case, "watched": draw_watched_case}
"""How the case of a seed is drawn, with at most so many parts to move, in each kind of series."""


def _spoil(rng: Random, seed: int, trouble: Fault, cell: Cell) -> Case:
    part = next(each for each in cell.parts if each.name == cell.goal[-1][0])
    (x, y, z), (_, width, height) = part.at, part.size
    match trouble:
        case "no support":
            return _known(seed, trouble, _without_bin(cell))
        case "full bin":
            return _known(seed, trouble, _filled(cell))
        case "too wide":
            wide = replace(part, shape="box", size=(0.17, 0.17, height))
            return _known(seed, trouble, _only(cell, wide))
        case "slippery":
            return Case(seed, trouble, cell, _with(cell, replace(part, friction=0.01)))
        case "too heavy":
            return Case(seed, trouble, cell, _with(cell, replace(part, mass_kg=round(rng.uniform(25.0, 40.0), 1))))
        case "displaced":
            aside = replace(part, at=(x + (0.15 if x < 0.48 else -0.15), y, z))
            return Case(seed, trouble, _only(cell, part), _only(cell, aside))
        case "fallen over":
            tall = replace(part, shape="box", size=(width, width, 0.07), at=(x, y, TABLE_M + 0.035))
            lying = replace(tall, roll_deg=90.0, at=(x, y, TABLE_M + width / 2))
            return Case(seed, trouble, _only(cell, tall), _only(cell, lying))
        case "taken away":
            return Case(seed, trouble, cell, cell, taken_at_s=round(rng.uniform(0.2, 15.0), 2))
        case "blocked way":
            return Case(seed, trouble, cell, _blocked(cell))
        case _:
            assert_never(trouble)


def _known(seed: int, trouble: Trouble, cell: Cell) -> Case:
    return Case(seed, trouble, cell, cell)


def _with(cell: Cell, part: Part) -> Cell:
    return replace(cell, parts=tuple(part if each.name == part.name else each for each in cell.parts))


def _only(cell: Cell, part: Part) -> Cell:
    """Return a cell with this part alone, so that it cannot touch others."""
    return replace(cell, parts=(part,), goal=(cell.goal[-1],))


def _without_bin(cell: Cell) -> Cell:
    """Return a cell in which the last goal is a place in the air, which no other part is to be put at."""
    part, target = cell.goal[-1]
    cell = replace(cell, goal=(*(each for each in cell.goal if each[1] != target), (part, target)))
    moved = (replace(b, size=None, at=(*b.at[:2], TABLE_M + 0.2)) if b.name == target else b for b in cell.bins)
    return replace(cell, bins=tuple(moved))


def _filled(cell: Cell) -> Cell:
    """Return a cell in which a block fills the bin of the last goal."""
    target = next(each for each in cell.bins if each.name == cell.goal[-1][1])
    assert target.size is not None
    length, width, height = target.size
    size = (round(length - 0.012, 4), round(width - 0.012, 4), round(height + 0.02, 4))
    block = Part("Block", "box", size, 0.5, (*target.at[:2], TABLE_M + 0.004 + size[2] / 2))
    return replace(cell, parts=(*cell.parts, block), contained=((block.name, target.name),))


def _blocked(cell: Cell) -> Cell:
    """Return a cell with a block in the bin of the last goal that nobody knows of."""
    target = next(each for each in cell.bins if each.name == cell.goal[-1][1])
    assert target.size is not None
    length, width, _ = target.size
    return replace(cell, boxes=(("Pillar", (length - 0.04, width - 0.04, 0.14), (*target.at[:2], TABLE_M + 0.14)),))
