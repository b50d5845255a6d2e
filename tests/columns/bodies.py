"""Draws bodies, each from a seed."""

from __future__ import annotations

from dataclasses import dataclass, field

from columns.drawing import Scope
from columns.libraries import Writer
from columns.loops import Listed, Loop, Rounds
from columns.meaning import Aggregate, Computed, Condition, Constant, Has, Joined, Read, Thing, Value
from columns.nodes import Beside, Block, Call, Node, Tally, Test, Timeout, Wait


@dataclass
class BodyWriter(Writer):
    """Draws bodies of the skills of its library, and compounds that they call."""

    tallies: list[Tally] = field(default_factory=list)

    def node(self, scope: Scope, depth: int) -> Node:
        """Draw a body."""
        if depth == 0 or self.chance(0.2):
            return self.leaf(scope)
        match self.random.randrange(12):
            case 8:
                return self.listed(scope, depth)
            case 10:
                return Timeout(self.random.randint(0, 5) + 0.4, self.node(scope, depth - 1))
            case 11:
                kind = self.random.choice(("all", "any", "race", "lead"))
                return Beside(kind, self.node(scope, depth - 1), self.random.randint(0, 5) + 0.8)
            case 0 | 1:
                return Block(self.random.choice(("seq", "seq", "sel")), self.nodes(scope, depth))
            case 2:
                return Block(self.random.choice(("try", "invert")), self.nodes(scope, depth)[:1])
            case 3:
                ends = [self.node(scope, depth - 2 if depth > 1 else 0) if self.chance(0.6) else None for _ in range(2)]
                return Block("seq", self.nodes(scope, depth), *ends)
            case 4:
                other = self.node(scope, depth - 1) if self.chance(0.5) else None
                return Test(self.condition(scope, 2), self.node(scope, depth - 1), other)
            case 5 | 6:
                return self.loop(scope, depth)
        count: Value = Constant(self.random.randint(1, 3))
        if self.chance(0.4):
            variable = self.variable()
            count = Aggregate("count", variable, "Item", self.atom({**scope, variable: "Item"}), None)
        word = self.random.choice(("repeat", "retry", "while"))
        condition = self.condition(scope, 1) if word == "while" else None
        return Rounds(word, Constant(3) if condition else count, condition, self.node(scope, depth - 1))

    def loop(self, scope: Scope, depth: int) -> Node:
        """Draw a loop over individuals."""
        variable, cls = self.variable(), self.random.choice(("Item", "Item", "Tray", "Spot"))
        inner = {**scope, variable: cls}
        where = self.condition(inner, 1) if self.chance(0.8) else None
        by: Value | None = None
        if cls != "Spot" and self.chance(0.6):
            by = Read(variable, (self.random.choice(("level", "size", "fill")),))
            by = Computed(Constant(0), "-", by) if self.chance(0.3) else by
        return Loop(variable, cls, where, by, self.node(inner, depth - 1))

    def listed(self, scope: Scope, depth: int) -> Node:
        """Draw a loop over a list."""
        variable, cls = self.variable(), self.random.choice(("Item", "Spot"))
        owner = self.pick(scope, "Item")
        members = [Thing(name) for _ in range(2) if (name := self.pick(scope, cls)) is not None]
        read = [Read(owner, ("at",))] if cls == "Spot" and owner is not None and self.chance(0.3) else []
        return Listed(variable, (*members, *read), self.node({**scope, variable: cls}, depth - 1))

    def nodes(self, scope: Scope, depth: int) -> tuple[Node, ...]:
        """Draw one to three nodes."""
        return tuple(self.node(scope, depth - 1) for _ in range(self.random.randint(1, 3)))

    def leaf(self, scope: Scope) -> Node:
        """Draw a call or a check."""
        if self.chance(0.15):
            return Test(self.condition(scope, 1))
        if self.chance(0.1):
            return Wait(self.random.choice((None, 1, 2)))
        if self.chance(0.1):
            return self.tally(scope)
        skill = self.random.choice(self.skills)
        arguments: dict[str, Value] = {}
        for each in skill.parameters:
            if each.of is None:
                name = self.pick(scope, each.cls)
                if name is None:
                    return Test(self.condition(scope, 1))
                arguments[each.name] = Thing(name)
                item = self.pick(scope, "Item")
                if each.cls == "Spot" and item is not None and self.chance(0.25):
                    arguments[each.name] = Read(item, ("at",))
        return Call(skill, arguments)

    def tally(self, scope: Scope) -> Node:
        """Draw a compound that computes something, and its call."""
        name = self.random.choice(sorted(scope))
        variable, cls = self.variable(), self.random.choice(("Item", "Spot"))
        where: Condition = self.condition({"a": scope[name], variable: cls}, 1)
        kind = self.random.choice(("count", "sum", "min", "max", "mean"))
        if kind != "count":
            where = Joined("and", Has(variable, "size"), where) if self.chance(0.8) else where
        value = Aggregate(kind, variable, cls, where, None if kind == "count" else Read(variable, ("size",)))
        number, more = Constant(self.random.randint(0, 3)), self.random.choice((None, None, 0, 2))
        rest = self.random.choice((None, None, 2))
        self.tallies.append(Tally(len(self.tallies), name, scope[name], value, self.operator(), number, more, rest))
        return self.tallies[-1]
