"""Walks over a program: every step, call, condition and value, nested ones included, in order of the text."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import (
    Call,
    Event,
    Implementation,
    Program,
    Requirement,
    Skill,
    TypedCondition,
    TypedExpression,
    TypedNode,
)


def steps(program: Program) -> Iterator[TypedNode]:
    """Yield every node of every body."""
    for implementation in program.implementations:
        if isinstance(implementation.body, TypedNode):
            yield from within(implementation.body)
    for task in program.tasks:
        if task.body:
            yield from within(task.body)


def within(step: TypedNode) -> Iterator[TypedNode]:
    """Yield a step and all steps in it."""
    yield step
    for child in (*step.children, *step.orelse):
        yield from within(child)


def calls(program: Program) -> Iterator[Call]:
    """Yield every call."""
    return (step.call for step in steps(program) if step.call)


def requirements(program: Program) -> Iterator[Requirement]:
    """Yield every pre-, hold and postcondition."""
    for skill in program.skills.values():
        yield from skill.requirements
    for implementation in program.implementations:
        yield from implementation.requirements


def clauses(program: Program) -> Iterator[TypedCondition]:
    """Yield every condition and its parts."""
    for requirement in requirements(program):
        yield from clauses_in(requirement.clause)
    for event in events(program):
        if event.clause:
            yield from clauses_in(event.clause)
    for task in program.tasks:
        if task.goal:
            yield from clauses_in(task.goal)
    for step in steps(program):
        for clause in step.clauses:
            yield from clauses_in(clause)


def events(program: Program) -> Iterator[Event]:
    """Yield what all `verify` lines speak of."""
    for implementation in program.implementations:
        for line in implementation.verify:
            yield from (event for event in (line.first, line.second) if event)


def clauses_in(clause: TypedCondition) -> Iterator[TypedCondition]:
    """Yield a condition and its parts."""
    yield clause
    for part in clause.parts:
        yield from clauses_in(part)


def values(program: Program) -> Iterator[TypedExpression]:
    """Yield every value and what it is made of."""
    for skill in program.skills.values():
        yield from _all(*skill_values(skill))
    for implementation in program.implementations:
        yield from _all(*implementation_values(implementation))
    for clause in clauses(program):
        yield from _all(*clause.values)
    for event in events(program):
        if event.measured:
            yield from _all(event.measured.limit)
    for step in steps(program):
        yield from _all(*step_values(step))


def skill_values(skill: Skill) -> Iterator[TypedExpression]:
    """Yield the values in a skill's head, without those in its conditions."""
    for parameter in skill.parameters:
        yield from (value for value in (parameter.default, parameter.low, parameter.high) if value)
    if skill.duration:
        yield skill.duration


def implementation_values(implementation: Implementation) -> Iterator[TypedExpression]:
    """Yield the values an implementation adds, without those in its conditions and body."""
    for new in implementation.refinements:
        yield from (value for value in (new.default, new.low, new.high) if value)
    if implementation.duration:
        yield implementation.duration
    yield from (let.value for let in implementation.lets)


def step_values(step: TypedNode) -> Iterator[TypedExpression]:
    """Yield the values of one node, those in its conditions excepted."""
    yield from step.values
    if step.call:
        yield from (argument.value for argument in step.call.arguments)


def values_in(value: TypedExpression) -> Iterator[TypedExpression]:
    """Yield a value and what it is made of."""
    yield value
    for part in value.parts:
        yield from values_in(part)


def _all(*whole: TypedExpression) -> Iterator[TypedExpression]:
    for value in whole:
        yield from values_in(value)
