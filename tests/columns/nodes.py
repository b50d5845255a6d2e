"""Bodies, and how each may end in a world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from columns.meaning import Compare, Computed, Condition, Constant, Value, named, thing
from columns.skills import Skill
from columns.worlds import World

End = tuple[bool | None, World]
"""Whether a body has succeeded, None if it was halted, and the world then."""
BROKEN = 0
"""How a body ends that has failed by a hold: as False, but `try` and `invert` do not hide it."""
LAG_S = 0.35
"""By how much the ticks between steps may make one end later, in s."""


def end_after(world: World, ok: bool, after: World) -> list[End]:
    """Return how something ends that began in a world and would end in another: it may be halted before."""
    halted: End = (None, replace(world, seconds=world.until))
    if after.seconds > world.until:
        return [halted]
    return [(ok, after), *([halted] if after.seconds > world.until - LAG_S else [])]


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
        names = {name: str(value) for name, value in bound.items()}
        if not all(each.holds(world, names) for each in self.skill.hold):
            return [(BROKEN, world), *([] if self.skill.fits(world, names) else [(False, world)])]
        after = self.skill.after(world, names)
        done = [end for each in after.values() for end in end_after(world, True, each.later(self.skill.seconds))]
        if done:
            return done
        # It fails when it starts, or when it ends, with what it has done by then.
        torn = self.skill.after(world, names, is_whole=False)
        late = (world, *torn.values())
        return [
            (False, world),
            *(end for each in late for end in end_after(world, False, each.later(self.skill.seconds))),
        ]


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
            found = [end for ok, at in found for end in self._handled(self.handler, ok, at, names)]
        return (
            found if self.last is None else [end for ok, at in found for end in self._at_last(self.last, ok, at, names)]
        )

    def _handled(self, handler: Node, ok: bool | None, at: World, names: Mapping[str, str]) -> list[End]:
        """Return the ends with what is done after a failure; a hold stays broken if that fails."""
        if ok is None or ok:
            return [(ok, at)]
        return [(ok if done is False else done, after) for done, after in handler.ends(at, names)]

    def _at_last(self, last: Node, ok: bool | None, at: World, names: Mapping[str, str]) -> list[End]:
        """Return the ends with what comes last, which does not run after a halt, and may be halted."""
        if ok is None:
            return [(ok, at)]
        return [(None if done is None else ok, after) for done, after in last.ends(at, names)]

    def _ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        goes_on = self.word != "sel"
        found: list[End] = [(goes_on, world)]
        for child in self.children:
            found = [
                end
                for ok, at in found
                for end in (
                    [(ok if not goes_on and done is False else done, after) for done, after in child.ends(at, names)]
                    if ok == goes_on
                    else [(ok, at)]
                )
            ]
        return [(self._decorated(ok), at) for ok, at in found]

    def _decorated(self, ok: bool | None) -> bool | None:
        if ok is None or ok is BROKEN or self.word not in ("try", "invert"):
            return ok
        return self.word == "try" or not ok


@dataclass(frozen=True)
class Timeout(Node):
    """`timeout 2.4 s`: no step ends just then."""

    seconds: float
    body: Node

    @property
    def text(self) -> str:
        return f"timeout {self.seconds} s {{ {self.body.text} }}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        return ends_within(self.body, world, names, self.seconds, then=False)


def ends_within(body: Node, world: World, names: Mapping[str, str], seconds: float, then: bool) -> list[End]:
    """Return how a body ends that is halted after some seconds; `then` is whether that is a success."""
    until = world.seconds + seconds
    if world.until <= until:
        return body.ends(world, names)
    found = body.ends(replace(world, until=until), names)
    return [(then if ok is None else ok, replace(at, until=world.until)) for ok, at in found]


@dataclass(frozen=True)
class Beside(Node):
    """A body beside a wait, in `par all`, `any`, `race` or `lead`."""

    kind: str
    body: Node
    seconds: float

    @property
    def text(self) -> str:
        return f"par {self.kind} {{\n{self.body.text}\nwait {self.seconds} s\n}}"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        waited = world.seconds + self.seconds
        if self.kind == "lead":
            return self.body.ends(world, names)
        if self.kind == "all":
            return [end for ok, at in self.body.ends(world, names) for end in self._waited(ok, at, waited)]
        ends = ends_within(self.body, world, names, self.seconds, then=True)
        if self.kind == "race":
            return ends
        return [end for ok, at in ends for end in ([(ok, at)] if ok or ok is None else self._waited(True, at, waited))]

    def _waited(self, ok: bool | None, at: World, waited: float) -> list[End]:
        """Return the end once the wait has ended too, unless the body has failed."""
        if not ok or at.seconds >= waited:
            return [(ok, at)]
        return end_after(at, True, replace(at, seconds=waited))


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
class Wait(Node):
    """`wait 2 s`, or `fail`."""

    seconds: int | None

    @property
    def text(self) -> str:
        return 'fail "as drawn"' if self.seconds is None else f"wait {self.seconds} s"

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        return [(False, world)] if self.seconds is None else end_after(world, True, world.later(self.seconds))


@dataclass(frozen=True)
class Tally(Node):
    """A call of a compound whose output is computed at its end, and what is asked of that."""

    number: int
    argument: str
    cls: str
    value: Value
    operator: str
    least: Constant
    more: int | None
    rest: int | None

    @property
    def text(self) -> str:
        given = (("more", self.more), ("rest", self.rest))
        more = "".join(f", {name}: {value}" for name, value in given if value is not None)
        call = f"Tally{self.number}(a: {named(self.argument)}{more}) -> v{self.number}"
        return f"seq {{\n{call}\ncheck(v{self.number} {self.operator} {self.least.text})\n}}"

    @property
    def skill(self) -> str:
        """The compound."""
        name = f"Tally{self.number}"
        given = ["    opt more: Number = 1", "    opt rest: Number", "    out n: Number", "    noplan", "}"]
        lines = [f"skill {name} {{", f"    in a: {self.cls}", *given, f"impl one of {name} {{"]
        body = "do if given rest { wait rest * 1 s } else { wait 1 s }"
        return "\n".join([*lines, f"    out n = {self.value.text} + more", f"    {body}", "}"])

    def ends(self, world: World, names: Mapping[str, str]) -> list[End]:
        found = self.value.of(world, {"a": thing(self.argument, names)})
        value = Computed(Constant(found), "+", Constant(1 if self.more is None else self.more))
        ok = found is not None and Compare(value, self.operator, self.least).holds(world, {})
        return end_after(world, ok, world.later(1 if self.rest is None else self.rest))
