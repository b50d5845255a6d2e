"""Loops of bodies, and how each may end in a world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from columns.meaning import Condition, Value
from columns.nodes import End, Node
from columns.worlds import World


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
