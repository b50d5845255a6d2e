"""Random cells: a fixed arm, a table, parts of four shapes and bins with margins; and ways to spoil one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random
from types import MappingProxyType

HEAD = """\
@prefix lab:     <http://example.org/lab#> .
@prefix contact: <https://w3id.org/skillc/contact#> .
@prefix skillc:  <https://w3id.org/skillc/core#> .
@prefix skiros:  <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Floor a skiros:Scene .
lab:Pedestal a skillc:Furniture ; skillc:on lab:Floor ;
    skiros:SizeX 0.3 ; skiros:SizeY 0.3 ; skiros:SizeZ 0.6 .
lab:Table a skillc:Furniture ; skillc:on lab:Floor ; skillc:atX 0.5 ;
    skiros:SizeX 0.6 ; skiros:SizeY 1.0 ; skiros:SizeZ 0.65 .
lab:FarTable a skillc:Furniture ; skillc:on lab:Floor ; skillc:atX 2.5 ;
    skiros:SizeX 0.6 ; skiros:SizeY 1.0 ; skiros:SizeZ 0.65 .
lab:Iiwa-1 a skillc:Iiwa14 ; skillc:hasSheet skillc:iiwa14-sheet ; skillc:on lab:Pedestal ;
    skiros:CompliantController "impedance" ; skillc:hasGripper lab:Wsg-1 .
lab:Wsg-1 a skillc:WsgGripper ; skillc:hasSheet skillc:wsg50-sheet .
"""
SLOTS = tuple((x, y) for x in (-0.06, 0.11) for y in (-0.36, -0.12, 0.12, 0.36))
"""Places on the table, from its middle, in m: nothing in one touches anything in another."""
SHAPES = ("box", "cylinder", "sphere", "capsule")
SIZES = ("skiros:SizeX", "skiros:SizeY", "skiros:SizeZ")


@dataclass(frozen=True)
class Thing:
    """A thing of a cell: its name and class, and its facts, which are numbers and texts in Turtle."""

    name: str
    cls: str
    facts: dict[str, str] = field(default_factory=dict)

    def with_facts(self, **facts: str | float) -> Thing:
        """Return the thing with other facts; `__` stands for the colon in their names."""
        written = {name.replace("__", ":"): str(fact) for name, fact in facts.items()}
        return replace(self, facts={**self.facts, **written})

    def without(self, *names: str) -> Thing:
        """Return the thing without some facts."""
        return replace(self, facts={name: fact for name, fact in self.facts.items() if name not in names})

    def __str__(self) -> str:
        lines = "".join(f" ;\n    {name} {fact}" for name, fact in self.facts.items())
        return f"lab:{self.name} a {self.cls}{lines} .\n"


@dataclass(frozen=True)
class Cell:
    """A cell: parts, bins and what else there is. Nothing in it is wrong, by a margin of at least 1 cm."""

    parts: tuple[Thing, ...]
    others: tuple[Thing, ...]

    def __str__(self) -> str:
        return HEAD + "".join(map(str, (*self.parts, *self.others)))

    def spoilt(self, how: Callable[[Thing, Random], Thing], random: Random) -> tuple[Cell, str]:
        """Return the cell with one part spoilt, and the name of the part."""
        index = random.randrange(len(self.parts))
        part = how(self.parts[index], random)
        return replace(self, parts=(*self.parts[:index], part, *self.parts[index + 1 :])), part.name


def random_cell(random: Random) -> Cell:
    """Return a cell with 1 to 5 parts and 1 to 3 bins."""
    near = random.sample([each for each in SLOTS if each[0] < 0.0], random.randint(1, 3))
    left = [each for each in SLOTS if each not in near]
    return Cell(
        tuple(_part(f"Part-{n}", slot, random) for n, slot in enumerate(random.sample(left, random.randint(1, 5)))),
        tuple(_bin(f"Bin-{n}", slot, random) for n, slot in enumerate(near)),
    )


def _on_table(name: str, cls: str, slot: tuple[float, float], random: Random, size: tuple[float, ...]) -> Thing:
    place = {"skillc:on": "lab:Table", "skillc:atX": f"{slot[0]}", "skillc:atY": f"{slot[1]}"}
    yaw = {"skillc:yaw": f"{random.uniform(-180, 180):.1f}"}
    return Thing(name, cls, {**place, **yaw, **{axis: f"{value:.4f}" for axis, value in zip(SIZES, size, strict=True)}})


def _part(name: str, slot: tuple[float, float], random: Random) -> Thing:
    shape = random.choice(SHAPES)
    x, y, z = (random.uniform(0.03, 0.07) for _ in range(3))
    size = {"box": (x, y, z), "cylinder": (x, x, z), "sphere": (x, x, x), "capsule": (x, x, x + z)}[shape]
    part = _on_table(name, "skiros:Product", slot, random, size)
    return part.with_facts(skillc__shape=f'"{shape}"', skiros__Weight=f"{random.uniform(0.05, 0.3):.3f}")


def _bin(name: str, slot: tuple[float, float], random: Random) -> Thing:
    x, y, z = random.uniform(0.15, 0.165), random.uniform(0.15, 0.165), random.uniform(0.04, 0.1)
    return _on_table(name, "skiros:Container", slot, random, (x, y, z)).with_facts(skillc__yaw=random.choice((0, 90)))


def _without_size(part: Thing, random: Random) -> Thing:
    return part.without(*SIZES)


def _oval(part: Thing, random: Random) -> Thing:
    return part.with_facts(skillc__shape='"cylinder"', skiros__SizeX=0.04, skiros__SizeY=random.uniform(0.05, 0.07))


def _sunk(part: Thing, random: Random) -> Thing:
    return part.with_facts(skillc__atZ=-random.uniform(0.012, 0.03))


def _raised(part: Thing, random: Random) -> Thing:
    return part.with_facts(skillc__atZ=random.uniform(0.015, 0.2))


def _over_the_edge(part: Thing, random: Random) -> Thing:
    """A box that stands on the table with a tenth of its length."""
    beyond = part.with_facts(skiros__SizeX=0.03, skiros__SizeY=0.1, skiros__SizeZ=0.04, skillc__yaw=0)
    return beyond.with_facts(skillc__shape='"box"', skillc__atX=-0.08, skillc__atY=0.5 + random.uniform(0.03, 0.04))


def _far(part: Thing, random: Random) -> Thing:
    return part.with_facts(skillc__on="lab:FarTable", skillc__atX=random.uniform(-0.2, 0.2))


def _wide(part: Thing, random: Random) -> Thing:
    sizes = {name: random.uniform(0.125, 0.15) for name in ("skiros__SizeX", "skiros__SizeY", "skiros__SizeZ")}
    return part.with_facts(skillc__shape='"box"', skillc__yaw=0, **sizes)


def _heavy(part: Thing, random: Random) -> Thing:
    return part.with_facts(skiros__Weight=random.uniform(15, 30))


SPOILED = MappingProxyType(
    {
        "no-body": _without_size,
        "impossible-body": _oval,
        "inside-another": _sunk,
        "no-support": _raised,
        "no-support-tips": _over_the_edge,
        "out-of-reach": _far,
        "too-wide": _wide,
        "too-heavy": _heavy,
    }
)
"""Ways to spoil a part, by the name of the diagnostic that they must give."""
