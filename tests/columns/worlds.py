"""The worlds of the columns: a few things, and facts about them as triples."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf
from random import Random

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.world_state import WorldState

TERMS = """use sumo
prefix lab: <http://example.org/lab#>
class    Spot < Object
class    Item < Object  disjoint Spot
class    Tray < Item
enum     Grade { Good, Bad, Odd }
relation at(Item, Spot)    functional
relation lies(Item, Tray)  functional
relation link(Spot, Spot)  symmetric
relation holds(Spot, Item) inverse at
property grade(Item): Grade
property open(Item): Bool
property level(Item): Int     range 0 .. 3
property fill(Item): Number   range 0 .. 1
property weight(Item): Mass   range 0 kg .. 2 kg
property heat(Item): Temperature  range 10 degC .. 40 degC
property size(Object): Number
relation standsIn(x: Item, s: Spot) = x at s or exists t: Tray (x lies t and t standsIn s)
relation isShut(x: Item, s: Spot) = x standsIn s and not exists t: Tray (x lies t and t.open == true)
relation reaches(s: Spot, o: Spot) = s link o or exists m: Spot (s link m and m reaches o)
"""
NS, LAB = "https://w3id.org/skillc/library/columns#", "http://example.org/lab#"
CLASSES = {"S1": "Spot", "S2": "Spot", "S3": "Spot", "I1": "Item", "I2": "Item", "T1": "Tray", "T2": "Tray"}
GRADES = ("Good", "Bad", "Odd")
STORED = {"at": ("Item", "Spot"), "lies": ("Item", "Tray"), "link": ("Spot", "Spot")}
DEFINED = {"standsIn": ("Item", "Spot"), "isShut": ("Item", "Spot"), "reaches": ("Spot", "Spot")}
DEFINED |= {"holds": ("Spot", "Item")}
FUNCTIONAL = ("at", "lies")
RANGES = {"level": (0, 3), "fill": (0, 1), "weight": (0, 2), "heat": (283.15, 313.15)}
Fact = tuple[str, str, object]
"""A relation or property, whose it is, and the other thing or the value."""


@dataclass(frozen=True)
class World:
    """The things that there are, and what is so.

    `seconds` is how long it took, and `until` when what runs is halted, which tell no worlds apart.
    """

    people: tuple[str, ...]
    facts: frozenset[Fact]
    seconds: float = field(default=0.0, compare=False)
    until: float = field(default=inf, compare=False)

    def later(self, seconds: float) -> World:
        """Return the world after some time."""
        return replace(self, seconds=self.seconds + seconds)

    def members(self, cls: str) -> list[str]:
        """Return the things of a class, in the order of their IRIs."""
        return [
            each for each in self.people if cls in ("Object", CLASSES[each]) or (cls, CLASSES[each]) == ("Item", "Tray")
        ]

    def value(self, owner: str, name: str) -> object:
        """Return the one value of a property or functional relation; None where there is none."""
        return self._values.get((name, owner))

    @cached_property
    def _values(self) -> dict[tuple[str, str], object]:
        return {(name, owner): value for name, owner, value in self.facts}

    def pairs(self, relation: str) -> set[tuple[str, str]]:
        """Return all pairs of a relation."""
        if relation not in self._pairs:
            self._pairs[relation] = self._list_pairs(relation)
        return self._pairs[relation]

    @cached_property
    def _pairs(self) -> dict[str, set[tuple[str, str]]]:
        return {}

    def _list_pairs(self, relation: str) -> set[tuple[str, str]]:
        """Return the pairs of a relation, computed as its definition says in the plainest way."""
        stored = {(one, str(other)) for name, one, other in self.facts if name == relation}
        match relation:
            case "link":
                return stored | {(other, one) for one, other in stored}
            case "holds":
                return {(spot, item) for item, spot in self.pairs("at")}
            case "standsIn":
                lies = self.pairs("lies")
                return _closed(self.pairs("at"), lambda found: {(x, s) for x, t in lies for u, s in found if t == u})
            case "isShut":
                covered = {x for x, t in self.pairs("lies") if self.value(t, "open") is True}
                return {(x, s) for x, s in self.pairs("standsIn") if x not in covered}
            case "reaches":
                link = self.pairs("link")
                return _closed(link, lambda found: {(s, o) for s, m in link for n, o in found if m == n})
        return stored

    def changed(self, gone: set[Fact], new: set[Fact]) -> World:
        """Return the world without some facts and with others; a new value takes the place of the old one."""
        replaced = {(name, owner) for name, owner, _ in new if name not in STORED or name in FUNCTIONAL}
        kept = {each for each in self.facts - gone if each[:2] not in replaced}
        return World(self.people, frozenset(kept | new), self.seconds, self.until)


def _closed(found: set[tuple[str, str]], step: object) -> set[tuple[str, str]]:
    while True:
        more = found | step(found)  # type: ignore[operator]
        if more == found:
            return found
        found = more


def draw_people(random: Random) -> tuple[str, ...]:
    """Draw which things there are: three to seven."""
    return tuple(sorted(["S1", "S2", "I1", *(each for each in ("S3", "I2", "T1", "T2") if random.random() < 0.5)]))


def draw_world(random: Random, people: tuple[str, ...]) -> World:
    """Draw facts about things."""
    world = World(people, frozenset())
    facts: set[Fact] = set()
    for item in world.members("Item"):
        trays = [each for each in world.members("Tray") if each != item]
        if trays and random.random() < 0.5:
            facts.add(("lies", item, random.choice(trays)))
        elif random.random() < 0.8:
            facts.add(("at", item, random.choice(world.members("Spot"))))
        drawn = {"open": random.random() < 0.5, "grade": random.choice(GRADES), "level": random.randint(0, 3)}
        drawn |= {"fill": random.choice((0.0, 0.25, 0.5, 1.0)), "size": float(random.choice((0, 1, 1, 2)))}
        drawn |= {"weight": random.choice((0.0, 0.25, 0.5, 2.0)), "heat": random.choice((288.15, 293.15, 298.15))}
        facts |= {(name, item, value) for name, value in drawn.items() if random.random() < 0.75}
    for spot in world.members("Spot"):
        if random.random() < 0.7:
            facts.add(("size", spot, float(random.randint(1, 3))))
        if random.random() < 0.5:
            facts.add(("link", spot, random.choice(world.members("Spot"))))
    return World(world.people, frozenset(facts))


def to_state(world: World, vocabulary: Vocabulary) -> WorldState:
    """Return the world as the product has it."""
    return WorldState.empty(vocabulary).with_changes(_changes(world, vocabulary))


def _changes(world: World, vocabulary: Vocabulary) -> Iterator[Change]:
    yield from (AddIndividual(LAB + each, (NS + CLASSES[each],)) for each in world.people)
    yield from (AddIndividual(each, (cls,)) for each, cls in vocabulary.enumerated.items())
    for name, owner, value in sorted(world.facts, key=str):
        if name == "grade":
            yield AddRelation(LAB + owner, NS + name, f"{NS}Grade-{value}")
        elif name in STORED:
            yield AddRelation(LAB + owner, NS + name, f"{LAB}{value}")
        else:
            yield SetProperty(LAB + owner, NS + name, value)  # type: ignore[arg-type]


def from_state(state: WorldState, people: tuple[str, ...]) -> World:
    """Return a world of the product as triples."""
    facts = {_ordered((name, _short(one), _short(other))) for name in STORED for one, other in state.pairs(NS + name)}
    facts |= {("grade", _short(one), other.removeprefix(f"{NS}Grade-")) for one, other in state.pairs(NS + "grade")}
    for name in ("open", *RANGES, "size"):
        for owner in people:
            value = state.value(LAB + owner, NS + name)
            if value is not None:
                facts.add((name, owner, rounded(value)))
    return World(people, frozenset(facts))


def rounded(value: object) -> object:
    """Return a number as it is compared: an integer is a number like any other."""
    return value if isinstance(value, bool | str) else round(float(value), 9)  # type: ignore[arg-type]


def normal(world: World) -> World:
    """Return the world as `from_state` writes it."""
    pairs = map(_ordered, world.facts)
    return World(world.people, frozenset((name, one, rounded(value)) for name, one, value in pairs), world.seconds)


def _ordered(fact: Fact) -> Fact:
    name, one, other = fact
    return (name, *sorted((one, str(other)))) if name == "link" else fact  # type: ignore[return-value]


def _short(iri: str) -> str:
    return iri.removeprefix(LAB)
