"""Iterators over bodies, conditions and expressions and what is nested in them, in source order."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.typed import Call, Implementation, Skill, TypedNode


def nodes_in(node: TypedNode) -> Iterator[TypedNode]:
    """Yield a node and all nodes in it."""
    waiting = [node]
    while waiting:
        inner = waiting.pop()
        yield inner
        if inner.children or inner.orelse:
            waiting += reversed((*inner.children, *inner.orelse))


def calls_in(node: TypedNode) -> Iterator[Call]:
    """Yield the calls in a node and in all nodes in it."""
    return (inner.call for inner in nodes_in(node) if inner.call)


def conditions_in(condition: TypedCondition) -> Iterator[TypedCondition]:
    """Yield a condition, its parts, and the conditions in its values."""
    yield condition
    for part in condition.parts:
        yield from conditions_in(part)
    for value in condition.values:
        yield from conditions_of(value)


def conditions_of(value: TypedExpression) -> Iterator[TypedCondition]:
    """Yield the conditions in an expression and their parts."""
    for each in values_in(value):
        for condition in each.conditions:
            yield from conditions_in(condition)


def skill_values(skill: Skill) -> Iterator[TypedExpression]:
    """Yield the expressions in the head of a skill, without those in its conditions."""
    for parameter in skill.parameters:
        yield from (value for value in (parameter.default, parameter.low, parameter.high) if value)
    yield from skill.senses
    yield from (value for value in (skill.duration, skill.cost) if value)
    if skill.pause and skill.pause.keep:
        yield skill.pause.keep


def implementation_values(implementation: Implementation) -> Iterator[TypedExpression]:
    """Yield the expressions that an implementation adds, without those in its conditions and body."""
    for new in implementation.refinements:
        yield from (value for value in (new.default, new.low, new.high) if value)
    if implementation.duration:
        yield implementation.duration
    yield from (let.value for let in implementation.lets)
    yield from (output.value for output in implementation.outputs)


def node_values(node: TypedNode) -> Iterator[TypedExpression]:
    """Yield the expressions of one node, without those in its conditions."""
    yield from node.values
    if node.call:
        yield from (argument.value for argument in node.call.arguments)


def values_in(value: TypedExpression) -> Iterator[TypedExpression]:
    """Yield an expression and its operands."""
    yield value
    for part in value.parts:
        yield from values_in(part)


def reads_in(value: TypedExpression) -> Iterator[TypedExpression]:
    """Yield an expression and its operands, also those of the conditions in it."""
    yield from values_in(value)
    for condition in conditions_of(value):
        yield from _all(*condition.values)


def _all(*whole: TypedExpression) -> Iterator[TypedExpression]:
    for value in whole:
        yield from values_in(value)
