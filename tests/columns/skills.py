"""Skills and bodies, and what each does to a world: several worlds may come of a skill with outcomes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from columns.effects import Effect
from columns.meaning import Condition, Value
from columns.worlds import FUNCTIONAL, STORED, Fact, World

End = tuple[bool, World]
"""Whether a body has succeeded, and the world then."""


@dataclass(frozen=True)
class Parameter:
    """`in`, or `infer` of what a functional relation of another parameter leads to."""

    name: str
    cls: str
    of: tuple[str, str] | None = None

    @property
    def lines(self) -> list[str]:
        if self.of is None:
            return [f"    in {self.name}: {self.cls}"]
        return [
            f"    infer {self.name}: {self.cls}",
            f"    pre found_{self.name}: {self.of[0]} {self.of[1]} {self.name}",
        ]


@dataclass(frozen=True)
class Outcome:
    """One of the things that may come of a skill, and how likely that is."""

    label: str
    effects: tuple[Effect, ...]
    likely: float | None = None


@dataclass(frozen=True)
class Skill:
    """A skill with its preconditions and effects."""

    name: str
    parameters: tuple[Parameter, ...]
    pre: tuple[Condition, ...]
    effects: tuple[Effect, ...]
    seconds: int
    uses: str | None = None
    senses: str | None = None
    outcomes: tuple[Outcome, ...] = ()

    @property
    def text(self) -> str:
        lines = [f"skill {self.name} {{", *(line for each in self.parameters for line in each.lines)]
        lines += [f"    pre p{number}: {each.text}" for number, each in enumerate(self.pre)]
        lines += [f"    post e{number}: {each.text}" for number, each in enumerate(self.effects)]
        lines += [f"    senses {self.senses}.grade"] if self.senses else []
        for each in self.outcomes:
            likely = "" if each.likely is None else f" likely {each.likely}"
            lines.append(f"    outcome {each.label}: {' and '.join(one.text for one in each.effects)}{likely}")
        lines += [f"    uses {self.uses}"] if self.uses else []
        lines += [f"    duration {self.seconds} s", "}"]
        return "\n".join([*lines, f'impl one of {self.name} {{ run python "skillc.primitives:StandIn" }}'])

    def calls(self, world: World) -> Iterator[Mapping[str, str]]:
        """Yield every choice of things of the right classes."""
        names = [each.name for each in self.parameters]
        for chosen in product(*(world.members(each.cls) for each in self.parameters)):
            yield dict(zip(names, chosen, strict=True))

    def after(self, world: World, names: Mapping[str, str]) -> dict[str, World]:
        """Return what may come of it, by the label of the outcome; nothing where it cannot start or cannot be done."""
        if not all(names[each.name] in world.members(each.cls) for each in self.parameters):
            return {}
        if not all(
            world.value(names[each.of[0]], each.of[1]) == names[each.name] for each in self.parameters if each.of
        ):
            return {}
        if not all(each.holds(world, names) for each in self.pre):
            return {}
        several = {each.label: each.effects for each in self.outcomes} or {"": ()}
        if self.senses and (known := world.value(names[self.senses], "grade")) is not None:
            several = {
                label: effects
                for label, effects in several.items()
                if ("grade", names[self.senses], known) in _new(effects, world, names)
            }
        ends = {label: _apply((*self.effects, *effects), world, names) for label, effects in several.items()}
        return {label: after for label, after in ends.items() if after is not None}


def _new(effects: tuple[Effect, ...], world: World, names: Mapping[str, str]) -> set[Fact]:
    return {fact for each in effects for fact in each.changes(world, names)[1]}


def _apply(effects: tuple[Effect, ...], world: World, names: Mapping[str, str]) -> World | None:
    """Return the world with all effects; None if one cannot be done, or they contradict each other."""
    if not all(each.allowed(world, names) for each in effects):
        return None
    gone: set[Fact] = set()
    new: set[Fact] = set()
    for each in effects:
        less, more = each.changes(world, names)
        gone, new = gone | less, new | more
    single = [(name, owner) for name, owner, _ in new if name not in STORED or name in FUNCTIONAL]
    if len(set(single)) < len(single):
        return None
    after = world.changed(gone, new)
    return after if all(each.came(after, world, names) for each in effects) else None


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
            if each.of is not None and bound.get(each.of[0]) is not None:
                bound[each.name] = world.value(str(bound[each.of[0]]), each.of[1])
        if None in bound.values():
            return [(False, world)]
        after = self.skill.after(world, {name: str(value) for name, value in bound.items()})
        return [(True, each) for each in after.values()] or [(False, world)]


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
