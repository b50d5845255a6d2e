"""The conditions on which a call in a body is reached."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Aggregate, Condition, Exists, Not


def branches_to(implementation: Implementation, call: Call, item: str = "") -> Iterator[Condition]:
    """Yield the conditions on which a call is reached, from the outer to the inner one.

    A loop is reached if there is something for a round; that over `item` is, as it is about one of these.
    """
    node = implementation.body if isinstance(implementation.body, TypedNode) else None
    while node is not None and node.call is not call:
        inner = next(
            (each for each in (*node.children, *node.orelse) if any(one is call for one in calls_in(each))), None
        )
        if inner is not None:
            yield from _condition_of(node, inner, item)
        node = inner


def _condition_of(node: TypedNode, inner: TypedNode, item: str) -> Iterator[Condition]:
    match node.written:
        case s.If():
            condition = node.conditions[0].meaning
            yield Not(condition) if any(each is inner for each in node.orelse) else condition
        case s.While():
            yield node.conditions[0].meaning
        case s.For() if isinstance(items := node.values[0].meaning, Aggregate) and items.variable != item:
            yield Exists(items.variable, items.cls, items.where)
