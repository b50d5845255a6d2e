"""Builds conditions."""

from __future__ import annotations

from typing import Literal, cast

from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.places import Child, MemberPart, find_part, keyword_at
from skillc_dsl.parsing.building.values import ValueBuilder
from skillc_dsl.parsing.tokens import Token


class ConditionBuilder(ValueBuilder):
    """Builds conditions; a value in place of a condition becomes `Bare`."""

    def implies(self, children: list[Child]) -> s.Implies:
        """`if_ implies then`"""
        return s.Implies(self.condition(children[0]), self.condition(children[2]), self.over(children))

    def or_(self, children: list[Child]) -> s.Or:
        """`a or b or c`"""
        parts = [self.condition(child) for child in children[::2]]
        flat = (inner for part in parts for inner in (part.parts if isinstance(part, s.Or) else (part,)))
        return s.Or(tuple(flat), self.over(children))

    def and_(self, children: list[Child]) -> s.And:
        """`a and b and c`"""
        parts = [self.condition(child) for child in children[::2]]
        flat = (inner for part in parts for inner in (part.parts if isinstance(part, s.And) else (part,)))
        return s.And(tuple(flat), self.over(children))

    def not_(self, children: list[Child]) -> s.Not:
        """`not body`"""
        return s.Not(self.condition(children[1]), self.over(children))

    def quantified(self, children: list[Child]) -> s.Quantified:
        """`exists x: Class (body)`, `forall x: Class, y: Class (body)`, `forall x: Class (body when condition)`

        Several variables are those of quantifiers within each other.
        """
        word: Literal["exists", "forall"] = "exists" if keyword_at(children, 0) == "exists" else "forall"
        *head, _, inner, _ = children
        parts = inner.children if isinstance(inner, MemberPart) else (inner,)
        body, *when = (self.condition(each) for each in parts[::2])
        variables = [(self.label(label), self.as_name(cls)) for label, cls in zip(head[1::3], head[2::3], strict=True)]
        (name, cls), *outer = reversed(variables)
        found = s.Quantified(word, name, cls, body, self.over(children), next(iter(when), None))
        for name, cls in outer:
            found = s.Quantified(word, name, cls, found, found.span)
        return found

    def conditional(self, children: list[Child]) -> MemberPart:
        """`body when condition`"""
        return self.part("conditional", children)

    def aggregate(self, children: list[Child]) -> s.Aggregate:
        """`sum(x: Class where condition, value)`"""
        function, variable, cls = self.as_name(children[0]), self.label(children[2]), self.as_name(children[3])
        last = children[-2] if keyword_at(children, len(children) - 3) == "," else None
        value = None if last is None else self.value(last)
        return s.Aggregate(function, variable, cls, self.filter(children), value, self.over(children))

    def where(self, children: list[Child]) -> MemberPart:
        """`where condition`"""
        return self.part("where", children)

    def filter(self, children: list[Child]) -> s.Condition | None:
        """Return the condition after `where` among these parts, or None."""
        where = find_part(children, "where")
        return None if where is None else self.condition(where.children[1])

    def compare(self, children: list[Child]) -> s.Compare:
        """`left == right` and its like"""
        left, _, right = children
        operator = cast(s.CompareOperator, keyword_at(children, 1))
        return s.Compare(self.value(left), operator, self.value(right), self.over(children))

    def change(self, children: list[Child]) -> s.Change:
        """`property -= amount`, `property += amount .. to`"""
        of, _, amount, *rest = children
        operator = cast(s.ChangeOperator, keyword_at(children, 1))
        to = self._individual(rest[1]) if rest else None
        return s.Change(self.value(of), operator, self._individual(amount), to, self.over(children))

    def relation_of(self, children: list[Child]) -> s.Relation:
        """`subject relation object`"""
        subject, relation, object_ = children
        span = self.over(children)
        return s.Relation(self._individual(subject), self.as_name(relation), self._individual(object_), span)

    def anything(self, children: list[Token]) -> s.Anything:
        """`_`"""
        return s.Anything(self.place(children[0]))

    def has(self, children: list[Child]) -> s.Has:
        """`subject has property`"""
        return s.Has(self.value(children[0]), self.as_name(children[2]), self.over(children))

    def is_(self, children: list[Child]) -> s.Is:
        """`subject is Class`"""
        return s.Is(self.value(children[0]), self.as_name(children[2]), self.over(children))

    def given(self, children: list[Child]) -> s.Given:
        """`given parameter`"""
        return s.Given(self.as_name(children[1]), self.over(children))

    def condition(self, child: Child) -> s.Condition:
        """Return a condition; a value becomes `Bare`."""
        if isinstance(child, s.Condition):
            return child
        return s.Bare(self.value(child), self.place(child))

    def _individual(self, child: Child) -> s.Value | s.Anything:
        return child if isinstance(child, s.Anything) else self.value(child)
