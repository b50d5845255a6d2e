"""Draws libraries of edition 2, goals and bodies, each from a seed."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

from columns.effects import Becomes, Changes, Effect, Many
from columns.meaning import (
    Aggregate,
    Compare,
    Computed,
    Condition,
    Constant,
    Has,
    Holds,
    IsA,
    Joined,
    Not,
    Quantified,
    Read,
    Thing,
    Value,
)
from columns.skills import Block, Call, Loop, Node, Outcome, Parameter, Rounds, Skill, Test
from columns.worlds import CLASSES, DEFINED, GRADES, STORED, World

Scope = dict[str, str]
"""The class of each name."""


@dataclass
class Writer:
    """Draws what belongs to one library."""

    random: Random
    sums: bool = False
    variables: int = 0
    skills: list[Skill] = field(default_factory=list)

    def chance(self, share: float) -> bool:
        """Return true for this share of draws."""
        return self.random.random() < share

    def variable(self) -> str:
        """Return a name that is not in use."""
        self.variables += 1
        return f"x{self.variables}"

    def pick(self, scope: Scope, *classes: str) -> str | None:
        """Draw a name of one of the classes."""
        fits = [name for name, cls in scope.items() if cls in classes or (cls == "Tray" and "Item" in classes)]
        return self.random.choice(fits) if fits else None

    def library(self) -> list[Skill]:
        """Draw three or four skills."""
        self.skills = [self.skill(number) for number in range(self.random.randint(2, 3))]
        if self.chance(0.4):
            self.skills.append(self.look())
        return self.skills

    def skill(self, number: int) -> Skill:
        """Draw a skill without outcomes."""
        parameters = [
            Parameter(name, self.random.choice(("Item", "Item", "Tray", "Spot")))
            for name in "abc"[: self.random.randint(1, 3)]
        ]
        scope = {each.name: each.cls for each in parameters}
        item = self.pick(scope, "Item")
        if item is not None and self.chance(0.4):
            relation = self.random.choice(("at", "lies"))
            parameters.append(Parameter("f", STORED[relation][1], (item, relation)))
            scope["f"] = STORED[relation][1]
        pre = tuple(
            self.condition(scope, self.random.choice((0, 1, 2))) for _ in range(self.random.choice((0, 1, 1, 2)))
        )
        effects: dict[str, Effect] = {}
        for _ in range(self.random.choice((1, 1, 2, 2, 3))):
            effect = self.effect(scope)
            effects.setdefault(effect.writes, effect)
        uses = self.pick(scope, "Item", "Spot") if self.chance(0.2) else None
        return Skill(f"S{number}", tuple(parameters), pre, tuple(effects.values()), self.random.randint(1, 4), uses)

    def look(self) -> Skill:
        """Draw a skill that finds out a grade, with two or three outcomes."""
        parameters = (Parameter("a", "Item"),)
        pre = (self.condition({"a": "Item"}, 1),) if self.chance(0.5) else ()
        labels = self.random.sample(GRADES, self.random.choice((2, 3, 3)))
        outcomes = tuple(
            Outcome(each.lower(), (Becomes("a", "grade", each),), 0.3 if not at else None)
            for at, each in enumerate(labels)
        )
        return Skill("Look", parameters, pre, (), 1, None, "a", outcomes)

    def effect(self, scope: Scope) -> Effect:
        """Draw an effect."""
        if self.chance(0.3):
            variable, cls = self.variable(), self.random.choice(("Item", "Item", "Tray", "Spot"))
            inner = self.plain(scope, {variable: cls})
            if inner is not None:
                when = self.condition({**scope, variable: cls, "": cls}, 1) if self.chance(0.85) else None
                return Many(variable, cls, (inner,), when)
        if self.chance(0.35) and (owner := self.pick(scope, "Item")) is not None:
            return self.change(scope, owner)
        found = self.plain(scope, scope)
        return found if found is not None else Becomes(next(iter(scope)), "link", next(iter(scope)))

    def plain(self, scope: Scope, owners: Scope) -> Effect | None:
        """Draw a relation or property of one of the owners."""
        owner = self.pick(owners, "Item")
        if owner is None:
            spot, other = self.pick(owners, "Spot"), self.pick(scope, "Spot")
            return Becomes(spot, "link", other, self.chance(0.6)) if spot and other else None
        match self.random.randrange(5):
            case 0:
                return Becomes(owner, "open", self.chance(0.5))
            case 1:
                return Becomes(owner, "grade", self.random.choice(GRADES))
            case 2:
                return Becomes(owner, "level", self.random.randint(0, 3))
        relation = self.random.choice(("at", "lies"))
        other = self.pick(scope, STORED[relation][1])
        if other is None or self.chance(0.2):
            return Becomes(owner, relation, "_", False)
        return Becomes(owner, relation, other, self.chance(0.8))

    def change(self, scope: Scope, owner: str) -> Effect:
        """Draw a change of a number."""
        if self.chance(0.5):
            amount: Value = self.random.choice(
                (Constant(1), Constant(2), Read(self.pick(scope, "Item") or owner, ("level",)))
            )
            return Changes(owner, "level", self.random.choice(("+=", "-=", ":=")), amount)
        more = Computed(Constant(0.25), "*", Read(self.random.choice(list(scope)), ("size",)))
        amount = self.random.choice((Constant(0.25), Constant(0.5), more, Read(owner, ("fill",))))
        return Changes(owner, "fill", self.random.choice(("+=", "-=", ":=")), amount)

    def condition(self, scope: Scope, depth: int) -> Condition:
        """Draw a condition on what is in scope; a name in it that is empty stands for the last variable."""
        scope = {name: cls for name, cls in scope.items() if name}
        if depth == 0 or self.chance(0.35):
            return self.atom(scope)
        match self.random.randrange(4):
            case 0:
                return Not(self.condition(scope, depth - 1))
            case 1:
                word = self.random.choice(("and", "or", "implies"))
                return Joined(word, self.condition(scope, depth - 1), self.condition(scope, depth - 1))
            case 2:
                variable, cls = self.variable(), self.random.choice(("Item", "Item", "Tray", "Spot"))
                inner = self.condition({**scope, variable: cls}, depth - 1)
                return Quantified(self.random.choice(("exists", "forall")), variable, cls, inner)
            case _:
                return self.counted(scope)

    def atom(self, scope: Scope) -> Condition:
        """Draw a condition without parts."""
        item = self.pick(scope, "Item")
        if item is None or self.chance(0.35):
            relation, (first, second) = self.random.choice([*STORED.items(), *DEFINED.items()])
            one, other = self.pick(scope, first), self.pick(scope, second)
            if one is None:
                return IsA(next(iter(scope)), "Spot") if not item else Has(item, "at")
            return Holds(one, relation, "_" if other is None or (self.chance(0.2) and relation in STORED) else other)
        number = self.random.choice(("level", "fill"))
        operator = self.random.choice(("==", "!=", "<", "<=", ">", ">="))
        match self.random.randrange(8):
            case 0:
                return Compare(Read(item, ("open",)), "==", Constant(self.chance(0.5)))
            case 1:
                return Compare(
                    Read(item, ("grade",)), self.random.choice(("==", "!=")), Constant(self.random.choice(GRADES))
                )
            case 2 | 3:
                return Compare(
                    Read(item, (number,)),
                    operator,
                    Constant(self.random.choice((0, 1, 2) if number == "level" else (0.25, 0.5))),
                )
            case 4:
                return Compare(Read(item, (number,)), operator, Read(self.pick(scope, "Item") or item, (number,)))
            case 5 if spot := self.pick(scope, "Spot"):
                return Compare(Read(item, ("at",)), self.random.choice(("==", "!=")), Thing(spot))
            case 6:
                return Compare(
                    Read(item, (self.random.choice(("at", "lies")), "size")),
                    operator,
                    Constant(self.random.choice((1, 2))),
                )
        return self.random.choice((Has(item, self.random.choice(("grade", "at", "level", "open"))), IsA(item, "Tray")))

    def counted(self, scope: Scope) -> Condition:
        """Draw a comparison of a count, or of a sum of what no skill changes unless `sums`."""
        variable, cls = self.variable(), self.random.choice(("Item", "Item", "Spot"))
        operator = self.random.choice(("==", "!=", "<", "<=", ">", ">="))
        if not self.sums or self.chance(0.5):
            inner = self.condition({**scope, variable: cls}, 0)
            return Compare(
                Aggregate("count", variable, cls, inner, None), operator, Constant(self.random.randint(0, 3))
            )
        kind = self.random.choice(("sum", "min", "max", "mean"))
        name = self.random.choice(("level", "size")) if cls == "Item" else "size"
        known = Joined("and", Has(variable, name), self.condition({**scope, variable: cls}, 0))
        return Compare(
            Aggregate(kind, variable, cls, known, Read(variable, (name,))),
            operator,
            Constant(self.random.randint(0, 3)),
        )

    def goal(self, world: World, wanted: World) -> Condition:
        """Draw a goal: some of what is so in another world, or any condition."""
        people = {each: CLASSES[each] for each in world.people}
        new = sorted(wanted.facts - world.facts, key=str)
        if not new or self.chance(0.25):
            return self.condition(people, 2)
        parts: list[Condition] = []
        for name, owner, value in self.random.sample(new, min(len(new), self.random.randint(1, 3))):
            parts.append(
                Holds(owner, name, str(value))
                if name in STORED
                else Compare(Read(owner, (name,)), "==", Constant(value))
            )
        if self.chance(0.2):
            parts.append(self.atom(people))
        found = parts[0]
        for each in parts[1:]:
            found = Joined("and", found, each)
        return found

    def node(self, scope: Scope, depth: int) -> Node:
        """Draw a body."""
        if depth == 0 or self.chance(0.2):
            return self.leaf(scope)
        match self.random.randrange(8):
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

    def nodes(self, scope: Scope, depth: int) -> tuple[Node, ...]:
        """Draw one to three nodes."""
        return tuple(self.node(scope, depth - 1) for _ in range(self.random.randint(1, 3)))

    def leaf(self, scope: Scope) -> Node:
        """Draw a call or a check."""
        if self.chance(0.15):
            return Test(self.condition(scope, 1))
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
