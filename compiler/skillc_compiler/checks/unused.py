"""Values and parameters that are never used."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Skill, Task, TypedNode
from skillc_compiler.program.walk import (
    conditions_in,
    implementation_values,
    node_values,
    nodes_in,
    reads_in,
    skill_values,
)
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_model.conditions import Given, Variable

NAMES = ("unused-let", "unused-parameter")
NEEDS = Need.BODY
READS = Reads.FAMILY


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each value and parameter that can be removed without changing anything."""
    for implementation in program.implementations:
        read = _names_read_in(implementation)
        for let in implementation.lets:
            if let.name.text not in read:
                yield report_unused("unused-let", let.name.span, f"the value `{let.name.text}` is never used")
    for skill in program.skills.values():
        yield from _parameters(program, skill)
    for task in program.tasks:
        yield from _task_parameters(task)


def report_unused(name: str, span: Span, message: str) -> Diagnostic:
    """Return the warning about something at a place that can be removed."""
    return Diagnostic(name, span, message, help="remove it", severity="warning")


def _parameters(program: Program, skill: Skill) -> Iterator[Diagnostic]:
    implementations = program.implementations_of[skill.name]
    if not implementations or any(not isinstance(i.body, TypedNode) for i in implementations):
        return
    read = {device.parameter.text for device in skill.devices}
    read |= _names(skill_values(skill), (r.condition for r in skill.requirements))
    for implementation in implementations:
        read |= _names_read_in(implementation)
    for parameter in skill.parameters:
        if parameter.name not in read and parameter.direction != "out":
            yield report_unused("unused-parameter", parameter.span, f"the parameter `{parameter.name}` is never used")


def _task_parameters(task: Task) -> Iterator[Diagnostic]:
    nodes = tuple(nodes_in(task.body)) if task.body else ()
    read = _names((), (task.goal,) if task.goal else ())
    for node in nodes:
        read |= _names(node_values(node), node.conditions)
    for parameter in task.parameters:
        if parameter.name not in read:
            yield report_unused("unused-parameter", parameter.span, f"the parameter `{parameter.name}` is never used")


def _names_read_in(implementation: Implementation) -> set[str]:
    """Return the names that an implementation reads itself."""
    read = _names(implementation_values(implementation), (r.condition for r in implementation.requirements))
    if isinstance(implementation.body, TypedNode):
        for node in nodes_in(implementation.body):
            read |= _names(node_values(node), node.conditions)
    for event in (event for line in implementation.verify for event in (line.first, line.second) if event):
        limits = (event.measured.limit,) if event.measured else ()
        read |= _names(limits, (event.condition,) if event.condition else ())
    return read


def _names(values: Iterable[TypedExpression], given_conditions: Iterable[TypedCondition]) -> set[str]:
    conditions = [part for condition in given_conditions for part in conditions_in(condition)]
    read = [part for value in (*values, *(v for c in conditions for v in c.values)) for part in reads_in(value)]
    given = {c.meaning.parameter for c in conditions if isinstance(c.meaning, Given)}
    return given | {value.meaning.name for value in read if isinstance(value.meaning, Variable)}
