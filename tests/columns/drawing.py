"""Draws conditions of edition 2 on what is in scope, each from a seed."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from columns.meaning import (
    OPERATORS,
    Aggregate,
    Compare,
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
)
from columns.numbers import STEPS
from columns.worlds import DEFINED, GRADES, STORED

Scope = dict[str, str]
"""The class of each name."""


@dataclass
class Drawer:
    """Draws conditions; sums of what skills change only with `sums`, since no planner takes them."""

    random: Random
    sums: bool = False
    variables: int = 0

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
                new = {self.variable(): self.choose_class() for _ in range(self.random.choice((1, 1, 2)))}
                inner = self.condition({**scope, **new}, depth - 1)
                return Quantified(self.random.choice(("exists", "forall")), tuple(new.items()), inner)
            case _:
                return self.counted(scope)

    def choose_class(self) -> str:
        """Draw a class."""
        return self.random.choice(("Item", "Item", "Tray", "Spot"))

    def operator(self) -> str:
        """Draw the operator of a comparison."""
        return self.random.choice(tuple(OPERATORS))

    def atom(self, scope: Scope) -> Condition:
        """Draw a condition without parts."""
        item = self.pick(scope, "Item")
        if item is None or self.chance(0.35):
            return self.related(scope, item)
        number = self.random.choice(tuple(STEPS))
        match self.random.randrange(10):
            case 0:
                return Compare(Read(item, ("open",)), "==", Constant(self.chance(0.5)))
            case 1:
                sign = self.random.choice(("==", "!="))
                return Compare(Read(item, ("grade",)), sign, Constant(self.random.choice(GRADES)))
            case 2 | 3:
                return Compare(Read(item, (number,)), self.operator(), self.random.choice(STEPS[number].values))
            case 4:
                other = self.pick(scope, "Item") or item
                return Compare(Read(item, (number,)), self.operator(), Read(other, (number,)))
            case 5 if spot := self.pick(scope, "Spot"):
                return Compare(Read(item, ("at",)), self.random.choice(("==", "!=")), Thing(spot))
            case 6:
                path = (self.random.choice(("at", "lies")), "size")
                return Compare(Read(item, path), self.operator(), Constant(self.random.choice((1, 2))))
            case 7:
                other, relation = self.pick(scope, "Item") or item, self.random.choice(("at", "lies"))
                sign = self.random.choice(("==", "!="))
                return Compare(Read(item, (relation,)), sign, Read(other, (relation,)))
        return self.random.choice((Has(item, self.random.choice(("grade", "at", *STEPS, "open"))), IsA(item, "Tray")))

    def related(self, scope: Scope, item: str | None) -> Condition:
        """Draw a relation, with `_` at times, or what can be said of those things that have none."""
        relation, (first, second) = self.random.choice([*STORED.items(), *DEFINED.items()])
        one, other = self.pick(scope, first), self.pick(scope, second)
        if one is None:
            return IsA(next(iter(scope)), "Spot") if not item else Has(item, "at")
        return Holds(one, relation, "_" if other is None or (self.chance(0.2) and relation in STORED) else other)

    def counted(self, scope: Scope) -> Condition:
        """Draw a comparison of a count, a sum, ..: of what no skill changes, unless `sums`."""
        variable, cls = self.variable(), self.random.choice(("Item", "Item", "Spot"))
        number = Constant(self.random.randint(0, 3))
        if self.chance(0.6):
            inner = self.condition({**scope, variable: cls}, 0)
            return Compare(Aggregate("count", variable, cls, inner, None), self.operator(), number)
        kind = self.random.choice(("sum", "min", "max", "mean"))
        name = self.random.choice(("level", "size")) if cls == "Item" and self.sums else "size"
        known: Condition = Has(variable, name)
        if self.sums:
            known = Joined("and", known, self.condition({**scope, variable: cls}, 0))
        elif self.chance(0.5):
            known = Compare(Read(variable, (name,)), self.operator(), Constant(1))
        return Compare(Aggregate(kind, variable, cls, known, Read(variable, (name,))), self.operator(), number)
