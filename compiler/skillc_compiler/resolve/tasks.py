"""Resolving tasks: parameters, a scene, and a goal or a body."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.typed import Parameter, Task
from skillc_compiler.program.types import type_of
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.nodes import resolve_node
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.type_names import resolve_type
from skillc_dsl import syntax as s


def resolve_task(context: FileContext, written: s.TaskDeclaration) -> Task:
    """Return the resolved task."""
    scope = Scope(f"the task `{written.name.text}`", skill=f"task {written.name.text}")
    parameters = tuple(_parameters(context, written))
    for parameter, each in zip(written.parameters, parameters, strict=True):
        scope = context.bind(scope, parameter.name, LocalName(each.type, "parameter", each.span))
    return Task(
        name=written.name.text,
        doc=written.doc,
        parameters=parameters,
        scene=written.scene.value if written.scene else None,
        goal=resolve_condition(context, scope, written.goal) if written.goal is not None else None,
        goal_text=written.goal_text,
        body=resolve_node(context, scope, written.body.node)[0] if written.body else None,
        name_span=written.name.span,
        span=written.span,
    )


def _parameters(context: FileContext, written: s.TaskDeclaration) -> Iterator[Parameter]:
    for each in written.parameters:
        declared = resolve_type(context.names, each.type)
        yield Parameter(
            name=each.name.text,
            direction="in",
            any_=False,
            declared=declared,
            type=type_of(declared),
            default=None,
            low=None,
            high=None,
            doc="",
            span=each.name.span,
        )
