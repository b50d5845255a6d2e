"""Iterators over a program: every node, call, condition and expression, nested ones included, in source order."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, Requirement, Skill, TypedNode, VerifyEvent


def all_nodes(program: Program) -> Iterator[TypedNode]:
    """Yield every node of every body."""
    for implementation in program.implementations:
        if isinstance(implementation.body, TypedNode):
            yield from nodes_in(implementation.body)
    for task in program.tasks:
        if task.body:
            yield from nodes_in(task.body)


def nodes_in(node: TypedNode) -> Iterator[TypedNode]:
    """Yield a node and all nodes in it."""
    waiting = [node]
    while waiting:
        inner = waiting.pop()
        yield inner
        if inner.children or inner.orelse:
            waiting += reversed((*inner.children, *inner.orelse))


def all_calls(program: Program) -> Iterator[Call]:
    """Yield every call, those after `pre of` included."""
    for skill in program.skills.values():
        yield from (each.call for each in skill.taken_over)
    yield from (node.call for node in all_nodes(program) if node.call)


def calls_in(node: TypedNode) -> Iterator[Call]:
    """Yield the calls in a node and in all nodes in it."""
    return (inner.call for inner in nodes_in(node) if inner.call)


def all_requirements(program: Program) -> Iterator[Requirement]:
    """Yield every pre-, hold and postcondition, and every outcome."""
    for skill in program.skills.values():
        yield from skill.requirements
    for implementation in program.implementations:
        yield from implementation.requirements


def all_conditions(program: Program) -> Iterator[TypedCondition]:
    """Yield every condition and its parts."""
    for relation in program.defined:
        yield from conditions_in(relation.condition)
    for requirement in all_requirements(program):
        yield from conditions_in(requirement.condition)
    for event in all_events(program):
        if event.condition:
            yield from conditions_in(event.condition)
    for task in program.tasks:
        for condition in task.conditions:
            yield from conditions_in(condition)
    for node in all_nodes(program):
        for condition in node.conditions:
            yield from conditions_in(condition)
    for value in _values_outside_conditions(program):
        yield from conditions_of(value)


def _values_outside_conditions(program: Program) -> Iterator[TypedExpression]:
    for skill in program.skills.values():
        yield from skill_values(skill)
    for implementation in program.implementations:
        yield from implementation_values(implementation)
    for event in all_events(program):
        if event.measured:
            yield event.measured.limit
    for task in program.tasks:
        if task.within:
            yield task.within
    for node in all_nodes(program):
        yield from node_values(node)


def all_events(program: Program) -> Iterator[VerifyEvent]:
    """Yield the events of all `verify` lines."""
    for implementation in program.implementations:
        for line in implementation.verify:
            yield from (event for event in (line.first, line.second) if event)


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


def all_values(program: Program) -> Iterator[TypedExpression]:
    """Yield every expression and its operands."""
    for condition in all_conditions(program):
        yield from _all(*condition.values)
    yield from _all(*_values_outside_conditions(program))


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
