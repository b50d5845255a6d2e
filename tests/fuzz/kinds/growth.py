"""Whatever is read as text takes time in proportion to its length: repeated pieces, twice as many, and so on."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from random import Random
from typing import NamedTuple

from fuzz.kinds._doors import DOORS, Door
from fuzz.kinds._growth import MOST_EXPONENT, measure_growth
from fuzz.kinds._pieces import NOISE

SECONDS = 60.0


class Shape(NamedTuple):
    """How a text is made: `opening` and `closing` are repeated between its other parts."""

    head: str
    opening: str
    middle: str
    closing: str
    tail: str

    def make(self, count: int) -> str:
        """Return the text with so many repetitions; a 0 becomes another number in each."""
        return "".join(
            (self.head, _repeated(self.opening, count), self.middle, _repeated(self.closing, count), self.tail)
        )


def run_case(random: Random, folder: Path) -> None:
    """Read texts of one shape in which pieces are repeated ever more often."""
    name = random.choice(sorted(DOORS))
    shape = draw_shape(random, DOORS[name])
    (folder / "shape.json").write_text(json.dumps([name, *shape]), "utf-8")
    check_growth(name, shape)


def draw_shape(random: Random, door: Door) -> Shape:
    """Return a shape: mostly one group of pieces many times, sometimes one group before and one after something."""
    head, tail = random.choice(door.frames)
    if random.random() < 0.4:
        return Shape(head, random.choice(door.pieces), "", "", tail)
    start, middle, closing, end = (_pieces(random, door) if random.random() < 0.3 else "" for _ in range(4))
    return Shape(head + start, _pieces(random, door), middle, closing, end + tail)


def check_growth(name: str, shape: Shape) -> None:
    """Raise if the time that a door takes for texts of a shape grows faster than their length."""
    door = DOORS[name]
    growth = measure_growth(door.read, shape.make, door.longest)
    assert growth.exponent <= MOST_EXPONENT, f"{name}: {growth} for {shape}"


def _pieces(random: Random, door: Door) -> str:
    count = random.choice((1, 1, 1, 2, 2, 3, 4))
    return "".join(random.choice(door.pieces if random.random() < 0.75 else NOISE) for _ in range(count))


def _repeated(piece: str, count: int) -> str:
    return "".join(piece.replace("0", str(number)) for number in range(count)) if "0" in piece else piece * count


if __name__ == "__main__":
    door, *parts = json.loads(Path(sys.argv[1]).read_text("utf-8"))
    check_growth(door, Shape(*parts))
