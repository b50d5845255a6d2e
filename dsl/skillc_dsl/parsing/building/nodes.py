"""Builds behaviour tree nodes."""

from __future__ import annotations

from typing import Literal, cast

from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.conditions import ConditionBuilder
from skillc_dsl.parsing.building.places import Child, MemberPart, children_of_type, find_part, first_of_type, keyword_at
from skillc_dsl.parsing.tokens import Token

BlockKind = Literal["seq", "sel", "reactive seq", "reactive sel", "par all", "par any", "par race", "par lead"]


class NodeBuilder(ConditionBuilder):
    """Builds nodes; the braces of a node are tokens among the children of its rule."""

    def block(self, children: list[Child]) -> s.Node:
        """`seq { }`, `par lead { }` and their like"""
        words = [child.value for child in children if isinstance(child, Token) and child.type not in _BRACES]
        kind, own = cast(BlockKind, " ".join(words)), _without_handler(children)
        return self.handled(s.Block(kind, self.nodes(own), self.over(own)), children)

    def on_failure(self, children: list[Child]) -> MemberPart:
        """`on failure as why { }` after a block"""
        return self.part("on_failure", children)

    def finally_(self, children: list[Child]) -> MemberPart:
        """`finally { }` after a block"""
        return self.part("finally_", children)

    def handled(self, block: s.Node, children: list[Child]) -> s.Node:
        """Return a block with what is done on failure and at the end, as far as that is among its parts."""
        node = block
        handler, last = find_part(children, "on_failure"), find_part(children, "finally_")
        if handler is not None:
            why, own = first_of_type(handler.children, s.Name), [each for each in children if each is not last]
            node = s.OnFailure(block, why, self.nodes(handler.children), self.over(own))
        return node if last is None else s.Finally(node, self.nodes(last.children), self.over(children))

    def decorator(self, children: list[Child]) -> s.Decorator:
        """`try { }`, `retry N { }`, `timeout Q { }` and their like"""
        start = next(at for at, child in enumerate(children) if isinstance(child, Token) and child.type == "LBRACE")
        slots = tuple(map(self.value, children[1:start]))
        return s.Decorator(keyword_at(children, 0), slots, self.nodes(children[start:]), self.over(children))

    def wait(self, children: list[Child]) -> s.Wait:
        """`wait Q`"""
        return s.Wait(self.value(children[1]), self.over(children))

    def wait_until(self, children: list[Child]) -> s.WaitUntil:
        """`wait until C`"""
        condition = self.condition(children[2])
        return s.WaitUntil(condition, self.written(condition.span), self.over(children))

    def if_(self, children: list[Child]) -> s.If:
        """`if C { } else { }`, `if C { } else if ..`"""
        condition = self.condition(children[1])
        then, orelse = find_part(children, "then"), find_part(children, "else_")
        return s.If(
            condition,
            self.written(condition.span),
            self.nodes(then.children if then else ()),
            self.nodes(orelse.children) if orelse else None,
            self.over(children),
        )

    def then(self, children: list[Child]) -> MemberPart:
        """`{ }` after the condition of an `if`"""
        return self.part("then", children)

    def else_(self, children: list[Child]) -> MemberPart:
        """`else { }`, `else if ..`"""
        return self.part("else_", children)

    def while_(self, children: list[Child]) -> s.While:
        """`while C max N { }`"""
        condition = self.condition(children[1])
        text, limit = self.written(condition.span), self.value(children[3])
        return s.While(condition, text, limit, self.nodes(children), self.over(children))

    def for_(self, children: list[Child]) -> s.For:
        """`for x in EXPR { }`, `for x: Class where C by EXPR { }`"""
        start = next(at for at, child in enumerate(children) if isinstance(child, Token) and child.type == "LBRACE")
        over, inner = self.over(children), self.nodes(children[start:])
        if isinstance(children[1], s.Name):
            return s.For(children[1], self.value(children[3]), inner, over)
        by = find_part(children, "by")
        value = self.value(by.children[1]) if by is not None else None
        every = s.Every(self.as_name(children[2]), self.filter(children), value, self.over(children[2:start]))
        return s.For(self.label(children[1]), every, inner, over)

    def by(self, children: list[Child]) -> MemberPart:
        """`by EXPR` in a loop"""
        return self.part("by", children)

    def check(self, children: list[Child]) -> s.CheckNode:
        """`check(C)`"""
        condition = self.condition(children[2])
        return s.CheckNode(condition, self.written(condition.span), self.over(children))

    def fail(self, children: list[Child]) -> s.Fail:
        """`fail "reason"`"""
        return s.Fail(self.message(children[1]), self.over(children))

    def apply_posts(self, children: list[Child]) -> s.ApplyPosts:
        """`apply LABEL, ..`"""
        return s.ApplyPosts(children_of_type(children, s.Name), self.over(children))

    def call(self, children: list[Child]) -> s.CallSkill:
        """`Skill[implementation](argument, ..) -> out`"""
        implementation, out = find_part(children, "implementation"), find_part(children, "out")
        return s.CallSkill(
            self.as_name(children[0]),
            self.as_name(implementation.children[1]) if implementation else None,
            children_of_type(children, s.Argument),
            self.as_name(out.children[1]) if out else None,
            self.over(children),
        )

    def implementation(self, children: list[Child]) -> MemberPart:
        """`[implementation]`"""
        return self.part("implementation", children)

    def out(self, children: list[Child]) -> MemberPart:
        """`-> out`"""
        return self.part("out", children)

    def argument(self, children: list[Child]) -> s.Argument:
        """`name: value`, `name`"""
        span = self.over(children)
        if isinstance(children[0], s.Name):
            return s.Argument(children[0], s.NameReference(children[0], span), span)
        return s.Argument(self.label(children[0]), self.value(children[1]), span)

    def with_(self, children: list[Child]) -> s.Node:
        """`with CALL { }`"""
        call = children[1]
        if not isinstance(call, s.CallSkill):
            raise TypeError(f"a call was expected, not {call!r}")
        own = _without_handler(children)
        return self.handled(s.With(call, self.nodes(own[2:]), self.over(own)), children)

    def nodes(self, children: list[Child] | tuple[Child, ...]) -> tuple[s.Node, ...]:
        """Return the nodes among `children`."""
        return tuple(child for child in children if isinstance(child, s.Node))


def _without_handler(children: list[Child]) -> list[Child]:
    return [child for child in children if not isinstance(child, MemberPart)]


_BRACES = ("LBRACE", "RBRACE")
