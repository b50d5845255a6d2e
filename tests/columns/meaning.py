"""Values and conditions with their text beside what they mean in a world, in the plainest way."""

from __future__ import annotations

import operator
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

from columns.worlds import CLASSES, World

Names = Mapping[str, str]
OPERATORS = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
KINDS = {"sum": sum, "min": min, "max": max}


def named(term: str) -> str:
    """Write a variable, or a thing of the scene."""
    return f"lab:{term}" if term in CLASSES else term


def thing(term: str, names: Names) -> str:
    """Return what a term stands for."""
    return names.get(term, term)


class Value:
    """What is compared; None where something is missing."""

    text: str

    def of(self, world: World, names: Names) -> object:
        raise NotImplementedError


class Condition:
    """What holds in a world or does not."""

    text: str

    def holds(self, world: World, names: Names) -> bool:
        raise NotImplementedError


@dataclass(frozen=True)
class Constant(Value):
    """A number, a truth value, a value of the enumeration."""

    value: object

    @property
    def text(self) -> str:
        return str(self.value).lower() if isinstance(self.value, bool) else f"{self.value}"

    def of(self, world: World, names: Names) -> object:
        return self.value


@dataclass(frozen=True)
class Thing(Value):
    """A thing itself."""

    term: str

    @property
    def text(self) -> str:
        return named(self.term)

    def of(self, world: World, names: Names) -> object:
        return thing(self.term, names)


@dataclass(frozen=True)
class Read(Value):
    """`x.at`, `x.level`, `x.at.size`."""

    owner: str
    path: tuple[str, ...]

    @property
    def text(self) -> str:
        return ".".join((named(self.owner), *self.path))

    def of(self, world: World, names: Names) -> object:
        found: object = thing(self.owner, names)
        for name in self.path:
            found = world.value(str(found), name) if found is not None else None
        return found


@dataclass(frozen=True)
class Computed(Value):
    """A sum, difference or product."""

    left: Value
    sign: str
    right: Value

    @property
    def text(self) -> str:
        return f"({self.left.text} {self.sign} {self.right.text})"

    def of(self, world: World, names: Names) -> object:
        sides = self.left.of(world, names), self.right.of(world, names)
        if None in sides:
            return None
        return {"+": operator.add, "-": operator.sub, "*": operator.mul}[self.sign](*sides)


@dataclass(frozen=True)
class Aggregate(Value):
    """`count(x: Item where C)`, `sum(x: Item where C, VALUE)`."""

    kind: str
    variable: str
    cls: str
    where: Condition
    value: Value | None

    @property
    def text(self) -> str:
        value = "" if self.value is None else f", {self.value.text}"
        return f"{self.kind}({self.variable}: {self.cls} where {self.where.text}{value})"

    def of(self, world: World, names: Names) -> object:
        found = [{**names, self.variable: each} for each in world.members(self.cls)]
        found = [each for each in found if self.where.holds(world, each)]
        if self.value is None:
            return len(found)
        values = [self.value.of(world, each) for each in found]
        if None in values or (not values and self.kind != "sum"):
            return None
        return sum(values) / len(values) if self.kind == "mean" else KINDS[self.kind](values)


@dataclass(frozen=True)
class Holds(Condition):
    """A relation, also with `_`."""

    subject: str
    relation: str
    other: str

    @property
    def text(self) -> str:
        return f"{named(self.subject)} {self.relation} {named(self.other)}"

    def holds(self, world: World, names: Names) -> bool:
        one, other = thing(self.subject, names), thing(self.other, names)
        pairs = world.pairs(self.relation)
        if "_" in (one, other):
            return any(one in ("_", subject) and other in ("_", object_) for subject, object_ in pairs)
        return (one, other) in pairs


@dataclass(frozen=True)
class Compare(Condition):
    """A comparison, which is false if a side is missing; numbers are compared to 1e-9."""

    left: Value
    operator: str
    right: Value

    @property
    def text(self) -> str:
        return f"{self.left.text} {self.operator} {self.right.text}"

    def holds(self, world: World, names: Names) -> bool:
        left, right = self.left.of(world, names), self.right.of(world, names)
        if left is None or right is None:
            return False
        if isinstance(left, float) or isinstance(right, float):
            left, right = round(float(left), 9), round(float(right), 9)  # type: ignore[arg-type]
        return bool(OPERATORS[self.operator](left, right))


@dataclass(frozen=True)
class Has(Condition):
    """`x has level`."""

    owner: str
    name: str

    @property
    def text(self) -> str:
        return f"{named(self.owner)} has {self.name}"

    def holds(self, world: World, names: Names) -> bool:
        return world.value(thing(self.owner, names), self.name) is not None


@dataclass(frozen=True)
class IsA(Condition):
    """`x is Tray`."""

    term: str
    cls: str

    @property
    def text(self) -> str:
        return f"{named(self.term)} is {self.cls}"

    def holds(self, world: World, names: Names) -> bool:
        return thing(self.term, names) in world.members(self.cls)


@dataclass(frozen=True)
class Not(Condition):
    """`not C`."""

    body: Condition

    @property
    def text(self) -> str:
        return f"not ({self.body.text})"

    def holds(self, world: World, names: Names) -> bool:
        return not self.body.holds(world, names)


@dataclass(frozen=True)
class Joined(Condition):
    """`and`, `or`, `implies`."""

    word: str
    left: Condition
    right: Condition

    @property
    def text(self) -> str:
        return f"(({self.left.text}) {self.word} ({self.right.text}))"

    def holds(self, world: World, names: Names) -> bool:
        left, right = self.left.holds(world, names), self.right.holds(world, names)
        return {"and": left and right, "or": left or right, "implies": not left or right}[self.word]


@dataclass(frozen=True)
class Quantified(Condition):
    """`exists x: Item (C)`, `forall x: Item, y: Spot (C)`."""

    word: str
    variables: tuple[tuple[str, str], ...]
    body: Condition

    @property
    def text(self) -> str:
        variables = ", ".join(f"{name}: {cls}" for name, cls in self.variables)
        return f"{self.word} {variables} ({self.body.text})"

    def holds(self, world: World, names: Names) -> bool:
        several = product(*(world.members(cls) for _, cls in self.variables))
        bound = (dict(zip(dict(self.variables), each, strict=True)) for each in several)
        found = (self.body.holds(world, {**names, **each}) for each in bound)
        return any(found) if self.word == "exists" else all(found)
