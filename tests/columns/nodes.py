"""Bodies, and how each may end in a world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from columns.meaning import Compare, Condition, Constant, Value, named, thing
from columns.skills import Skill
from columns.worlds import World

End = tuple[bool, World]
"""Whether a body has succeeded, and the world then."""


class Node:
    """A part of a body."""

    text: str

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        """Return how it may end."""
        raise NotImplementedError


@dataclass(frozen=True)
class Call(Node):
    """A call; what is inferred is not passed."""

    skill: Skill
    arguments: Mapping[str, Value]

    @property
    def text(self) -> str:
        given = ", ".join(f"{name}: {value.text}" for name, value in self.arguments.items())
        return f"{self.skill.name}({given})"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        bound = {name: value.of(world, names) for name, value in self.arguments.items()}
        for each in self.skill.parameters:
            if each.of is not None and (of := bound.get(each.of[0], each.of[0])) is not None:
                bound[each.name] = world.value(str(of), each.of[1])
        if None in bound.values():
            return [(False, world)]
        failed = [(False, world), (False, world.later(self.skill.seconds))]  # when it starts, or when it ends
        after = self.skill.after(world, {name: str(value) for name, value in bound.items()})
        return [(True, each.later(self.skill.seconds)) for each in after.values()] or failed


@dataclass(frozen=True)
class Block(Node):
    """`seq`, `sel`, `try`, `invert`, and what handles a failure or comes last."""

    word: str
    children: tuple[Node, ...]
    handler: Node | None = None
    last: Node | None = None

    @property
    def text(self) -> str:
        more = "" if self.handler is None else f" on failure {{ {self.handler.text} }}"
        more += "" if self.last is None else f" finally {{ {self.last.text} }}"
        return f"{self.word} {{\n" + "\n".join(each.text for each in self.children) + f"\n}}{more}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        found = self._ends(world, names)
        if self.handler is not None:
            found = [end for ok, at in found for end in ([(ok, at)] if ok else self.handler.ends(at, names))]
        if self.last is not None:
            found = [(ok, end) for ok, at in found for _, end in self.last.ends(at, names)]
        return found

    def _ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        goes_on = self.word != "sel"
        found: list[End] = [(goes_on, world)]
        for child in self.children:
            found = [end for ok, at in found for end in (child.ends(at, names) if ok == goes_on else [(ok, at)])]
        return [(True if self.word == "try" else ok != (self.word == "invert"), at) for ok, at in found]


@dataclass(frozen=True)
class Test(Node):
    """`check`, or `if` with its branches."""

    condition: Condition
    then: Node | None = None
    other: Node | None = None

    @property
    def text(self) -> str:
        if self.then is None:
            return f"check({self.condition.text})"
        other = "" if self.other is None else f" else {{ {self.other.text} }}"
        return f"if {self.condition.text} {{ {self.then.text} }}{other}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        holds = self.condition.holds(world, names)
        if self.then is None:
            return [(holds, world)]
        branch = self.then if holds else self.other
        return [(True, world)] if branch is None else branch.ends(world, names)


@dataclass(frozen=True)
class Loop(Node):
    """`for x: Item where C by VALUE`: which, and their order, is decided when it starts."""

    variable: str
    cls: str
    where: Condition | None
    by: Value | None
    body: Node

    @property
    def text(self) -> str:
        where = "" if self.where is None else f" where {self.where.text}"
        by = "" if self.by is None else f" by {self.by.text}"
        return f"for {self.variable}: {self.cls}{where}{by} {{ {self.body.text} }}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        found = [{**names, self.variable: each} for each in world.members(self.cls)]
        found = [each for each in found if self.where is None or self.where.holds(world, each)]
        if self.by is not None:
            keys = [self.by.of(world, each) for each in found]
            if None in keys:
                return [(False, world)]
            ordered = sorted(zip(keys, range(len(found)), strict=True))  # type: ignore[type-var]
            found = [found[number] for _, number in ordered]
        ends: list[End] = [(True, world)]
        for each in found:
            ends = [end for ok, at in ends for end in (self.body.ends(at, each) if ok else [(ok, at)])]
        return ends


@dataclass(frozen=True)
class Rounds(Node):
    """`repeat`, `retry` with a computed number, `while C max N`."""

    word: str
    count: Value
    condition: Condition | None
    body: Node

    @property
    def text(self) -> str:
        head = f"{self.word} {self.count.text}"
        if self.condition is not None:
            head = f"while {self.condition.text} max {self.count.text}"
        return f"{head} {{ {self.body.text} }}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        count = self.count.of(world, names)
        if not isinstance(count, int | float) or count < 1:
            return [(False, world)]
        going: list[End] = [(self.word != "retry", world)]
        done: list[End] = []
        for _ in range(int(count)):
            if self.condition is not None:
                done += [(True, at) for _, at in going if not self.condition.holds(at, names)]
                going = [(ok, at) for ok, at in going if self.condition.holds(at, names)]
            ends = [end for _, at in going for end in self.body.ends(at, names)]
            goes_on = self.word != "retry"
            done += [(ok, at) for ok, at in ends if ok != goes_on]
            going = [(ok, at) for ok, at in ends if ok == goes_on]
        if self.condition is not None:
            return done + [(not self.condition.holds(at, names), at) for _, at in going]
        return done + going


@dataclass(frozen=True)
class Listed(Node):
    """`for x in [..]`."""

    variable: str
    members: tuple[Value, ...]
    body: Node

    @property
    def text(self) -> str:
        members = ", ".join(each.text for each in self.members)
        return f"for {self.variable} in [{members}] {{ {self.body.text} }}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        found = [each.of(world, names) for each in self.members]
        if None in found:
            return [(False, world)]
        ends: list[End] = [(True, world)]
        for each in found:
            inner = {**names, self.variable: str(each)}
            ends = [end for ok, at in ends for end in (self.body.ends(at, inner) if ok else [(ok, at)])]
        return ends


@dataclass(frozen=True)
class Wait(Node):
    """`wait 2 s`, or `fail`."""

    seconds: int | None

    @property
    def text(self) -> str:
        return 'fail "as drawn"' if self.seconds is None else f"wait {self.seconds} s"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        return [(False, world)] if self.seconds is None else [(True, world.later(self.seconds))]


@dataclass(frozen=True)
class Tally(Node):
    """A call of a compound whose output is computed at its end, and what is asked of that."""

    number: int
    argument: str
    cls: str
    value: Value
    operator: str
    least: Constant

    @property
    def text(self) -> str:
        call = f"Tally{self.number}(a: {named(self.argument)}) -> v{self.number}"
        return f"seq {{\n{call}\ncheck(v{self.number} {self.operator} {self.least.text})\n}}"

    @property
    def skill(self) -> str:
        """The compound."""
        name = f"Tally{self.number}"
        lines = [f"skill {name} {{", f"    in a: {self.cls}", "    out n: Number", "    noplan", "}"]
        return "\n".join([*lines, f"impl one of {name} {{", f"    out n = {self.value.text}", "    do wait 1 s", "}"])

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        found = self.value.of(world, {"a": thing(self.argument, names)})
        if found is None:
            return [(False, world.later(1))]
        return [(Compare(Constant(found), self.operator, self.least).holds(world, {}), world.later(1))]
