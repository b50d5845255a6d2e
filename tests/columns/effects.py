"""Effects with their text beside what they do to a world."""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce

from columns.meaning import Condition, Constant, Holds, Names, Value, named, thing
from columns.worlds import FUNCTIONAL, RANGES, STORED, Fact, World


class Effect:
    """What becomes so; `writes` is the property or relation, by which contradictions within a skill are avoided."""

    text: str
    writes: str

    def changes(self, world: World, names: Names) -> tuple[set[Fact], set[Fact]]:
        """Return the facts that are gone and new, read in the world before."""
        raise NotImplementedError

    def allowed(self, world: World, names: Names) -> bool:
        """Whether it can be done: a number that changes is known and stays in its range."""
        return True

    def came(self, after: World, before: World, names: Names) -> bool:
        """Whether it is so at the end."""
        gone, new = self.changes(before, names)
        return new <= after.facts and not gone & after.facts


@dataclass(frozen=True)
class Becomes(Effect):
    """A relation or `not` one, a value of a property."""

    owner: str
    writes: str
    value: object
    positive: bool = True
    mirrored: bool = False

    @property
    def text(self) -> str:
        if self.writes not in STORED:
            return f"{named(self.owner)}.{self.writes} == {_shown(self.value)}"
        if self.mirrored:
            return f"{'' if self.positive else 'not '}{named(str(self.value))} holds {named(self.owner)}"
        return f"{'' if self.positive else 'not '}{named(self.owner)} {self.writes} {named(str(self.value))}"

    def changes(self, world: World, names: Names) -> tuple[set[Fact], set[Fact]]:
        owner = thing(self.owner, names)
        if self.writes not in STORED:
            value = self.value.value if isinstance(self.value, Constant) else self.value
            return set(), {(self.writes, owner, value)}
        other = thing(str(self.value), names)
        if not self.positive:
            sides = [(owner, other)] + ([(other, owner)] if self.writes == "link" else [])
            return {
                fact
                for fact in world.facts
                for one, two in sides
                if fact[0] == self.writes and one in ("_", fact[1]) and two in ("_", fact[2])
            }, set()
        pair = (owner, other) if self.writes in FUNCTIONAL else tuple(sorted((owner, other)))
        return set(), {(self.writes, *pair)}  # type: ignore[arg-type]

    def came(self, after: World, before: World, names: Names) -> bool:
        if self.writes not in STORED:
            return super().came(after, before, names)
        return Holds(self.owner, self.writes, str(self.value)).holds(after, names) == self.positive


@dataclass(frozen=True)
class Changes(Effect):
    """`+=`, `-=`, `:=` on a number."""

    owner: str
    writes: str
    operator: str
    amount: Value

    @property
    def text(self) -> str:
        return f"{named(self.owner)}.{self.writes} {self.operator} {self.amount.text}"

    def result(self, world: World, names: Names) -> float | None:
        now, amount = world.value(thing(self.owner, names), self.writes), self.amount.of(world, names)
        before = now if self.operator != ":=" else 0
        if not isinstance(before, int | float) or not isinstance(amount, int | float):
            return None
        return round(float(before + (-amount if self.operator == "-=" else amount)), 9)

    def allowed(self, world: World, names: Names) -> bool:
        low, high = RANGES[self.writes]
        result = self.result(world, names)
        return result is not None and low - 1e-9 <= result <= high + 1e-9

    def changes(self, world: World, names: Names) -> tuple[set[Fact], set[Fact]]:
        return set(), {(self.writes, thing(self.owner, names), self.result(world, names))}


@dataclass(frozen=True)
class Many(Effect):
    """`forall x: Item (.. when C)`."""

    variable: str
    cls: str
    inner: tuple[Effect, ...]
    when: Condition | None

    @property
    def writes(self) -> str:  # type: ignore[override]
        return self.inner[0].writes

    @property
    def text(self) -> str:
        when = "" if self.when is None else f" when {self.when.text}"
        return f"forall {self.variable}: {self.cls} ({' and '.join(each.text for each in self.inner)}{when})"

    def chosen(self, world: World, names: Names) -> list[Names]:
        found = ({**names, self.variable: each} for each in world.members(self.cls))
        return [each for each in found if self.when is None or self.when.holds(world, each)]

    def changes(self, world: World, names: Names) -> tuple[set[Fact], set[Fact]]:
        made = [each.changes(world, bound) for bound in self.chosen(world, names) for each in self.inner]
        return reduce(set.union, (gone for gone, _ in made), set()), reduce(set.union, (new for _, new in made), set())

    def allowed(self, world: World, names: Names) -> bool:
        return all(each.allowed(world, bound) for bound in self.chosen(world, names) for each in self.inner)

    def came(self, after: World, before: World, names: Names) -> bool:
        return all(each.came(after, before, bound) for bound in self.chosen(before, names) for each in self.inner)


def _shown(value: object) -> str:
    return value.text if isinstance(value, Constant) else Constant(value).text
