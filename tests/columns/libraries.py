"""Draws libraries of edition 2 and goals, each from a seed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from columns.drawing import Drawer, Scope
from columns.effects import Becomes, Changes, Effect, Many
from columns.meaning import Compare, Computed, Condition, Constant, Has, Holds, Joined, Quantified, Read, Value
from columns.numbers import STEPS, exactly
from columns.skills import Outcome, Parameter, Skill
from columns.worlds import CLASSES, DEFINED, GRADES, STORED, Fact, World


@dataclass
class Writer(Drawer):
    """Draws what belongs to one library."""

    skills: list[Skill] = field(default_factory=list)

    def library(self) -> list[Skill]:
        """Draw three or four skills."""
        self.skills = [self.skill(number) for number in range(self.random.randint(2, 3))]
        if self.chance(0.6):
            self.skills.append(self.look())
        if self.chance(0.3):
            self.skills.append(self.toss())
        return self.skills

    def skill(self, number: int) -> Skill:
        """Draw a skill without outcomes."""
        parameters = [Parameter(name, self.choose_class()) for name in "abc"[: self.random.randint(1, 3)]]
        scope = {each.name: each.cls for each in parameters}
        if self.chance(0.2):
            scope |= self.random.choice(({"S1": "Spot"}, {"I1": "Item"}))
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
        made = tuple(effects.values())
        return Skill(
            f"S{number}", tuple(parameters), pre, made, self.random.randint(1, 4), uses, hold=self.hold(scope, made)
        )

    def hold(self, scope: Scope, effects: Sequence[Effect]) -> tuple[Condition, ...]:
        """Draw what has to hold while a skill runs, of what it does not change itself; often nothing."""
        held = self.condition(scope, self.random.choice((0, 0, 1)))
        words = {*re.findall(r"\w+", held.text)}
        own = {each.writes for each in effects}
        is_own = not words.isdisjoint(own) or not (words.isdisjoint(DEFINED) or own.isdisjoint(STORED))
        return (held,) if self.chance(0.5) and not is_own else ()

    def look(self) -> Skill:
        """Draw a skill that finds out a grade or a level, with two or three outcomes."""
        parameters = (Parameter("a", "Item"),)
        pre = (self.condition({"a": "Item"}, 1),) if self.chance(0.3) else ()
        name = self.random.choice(("grade", "grade", "level"))
        values: tuple[object, ...] = GRADES if name == "grade" else (0, 1, 3)
        more = self.effect({"a": "Item"})
        outcomes = tuple(
            Outcome(
                f"o{at}",
                (Becomes("a", name, each), *((more,) if at == 1 and is_plain(more) and more.writes != name else ())),
                0.3 if not at else None,
            )
            for at, each in enumerate(self.random.sample(values, self.random.choice((2, 3, 3))))
        )
        return Skill("Look", parameters, pre, (), 1, None, ("a", name), outcomes)

    def toss(self) -> Skill:
        """Draw a skill of which chance decides what comes."""
        parameters = (Parameter("a", "Item"), Parameter("b", self.choose_class()))
        scope = {each.name: each.cls for each in parameters}
        pre = (self.condition(scope, 1),) if self.chance(0.5) else ()
        outcomes = []
        for label, value in (("up", True), ("down", False)):
            more = self.effect(scope)
            also = (more,) if self.chance(0.6) and is_plain(more) and more.writes != "open" else ()
            outcomes.append(Outcome(label, (Becomes("a", "open", value), *also)))
        return Skill("Toss", parameters, pre, (), self.random.randint(1, 2), None, None, tuple(outcomes))

    def effect(self, scope: Scope) -> Effect:
        """Draw an effect."""
        if self.chance(0.3):
            variable, cls = self.variable(), self.choose_class()
            inner = [each for _ in range(self.random.choice((1, 1, 2))) if (each := self.plain(scope, {variable: cls}))]
            if inner:
                when = self.condition({**scope, variable: cls}, 1) if self.chance(0.85) else None
                return Many(variable, cls, tuple({each.writes: each for each in inner}.values()), when)
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
        match self.random.randrange(6):
            case 0:
                return Becomes(owner, "open", self.chance(0.5))
            case 1:
                return Becomes(owner, "grade", self.random.choice(GRADES))
            case 2:
                name = self.random.choice(tuple(STEPS))
                return Becomes(owner, name, self.random.choice(STEPS[name].values))
        relation = self.random.choice(("at", "lies"))
        other = self.pick(scope, STORED[relation][1])
        if other is None or self.chance(0.2):
            return Becomes(owner, relation, "_", False)
        return Becomes(owner, relation, other, self.chance(0.8), relation == "at" and self.chance(0.3))

    def change(self, scope: Scope, owner: str) -> Effect:
        """Draw a change of a number."""
        name, sign = self.random.choice(tuple(STEPS)), self.random.choice(("+=", "-=", ":="))
        steps = STEPS[name].values if sign == ":=" else STEPS[name].steps
        amount: Value = self.random.choice(steps)
        if self.chance(0.3) and name != "heat":
            amount = Read(self.pick(scope, "Item") or owner, (name,))
        elif self.chance(0.3) and name in ("fill", "weight"):
            amount = Computed(self.random.choice(steps), "*", Read(self.random.choice(list(scope)), ("size",)))
        return Changes(owner, name, sign, amount)

    def goal(self, world: World, wanted: World) -> Condition:
        """Draw a goal: some of what is so in another world, or any condition."""
        people = {each: CLASSES[each] for each in world.people}
        new = sorted(wanted.facts - world.facts, key=str)
        looked = [each.senses[1] for each in self.skills if each.senses is not None]
        if looked and self.chance(0.7):
            return self.known(people, looked[0], [each for each in new if each[0] != looked[0]])
        if not new or self.chance(0.25):
            return self.condition(people, 2)
        parts: list[Condition] = []
        for name, owner, value in self.random.sample(new, min(len(new), self.random.randint(1, 3))):
            parts.append(is_so(name, owner, value))
        if self.chance(0.2):
            parts.append(self.atom(people))
        found = parts[0]
        for each in parts[1:]:
            found = Joined("and", found, each)
        return found

    def known(self, people: Scope, name: str, new: Sequence[Fact]) -> Condition:
        """Draw a goal over what is not known yet: for what there is, or for one thing; also of what can become so."""
        found = Has("I1", name)
        value = Constant(self.random.choice(GRADES) if name == "grade" else 1)
        also = is_so(*self.random.choice(new)) if new and self.chance(0.8) else self.condition(people, 1)
        match self.random.randrange(4):
            case 0:
                return found
            case 1:
                return Joined("and", found, Joined("implies", Compare(Read("I1", (name,)), "==", value), also))
        variable = self.variable()
        scope = {**people, variable: "Item"}
        found = Has(variable, name)
        more = Joined("implies", Compare(Read(variable, (name,)), "==", value), self.condition(scope, 0))
        return Quantified(
            "forall", ((variable, "Item"),), Joined("implies", self.condition(scope, 0), Joined("and", found, more))
        )


def is_so(name: str, owner: str, value: object) -> Condition:
    """Return that something is so."""
    if name in STORED:
        return Holds(owner, name, str(value))
    return Compare(Read(owner, (name,)), "==", exactly(name, value))


def is_plain(effect: Effect) -> bool:
    """Whether an effect may be that of an outcome."""
    return not isinstance(effect, Changes)
