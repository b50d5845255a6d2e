"""Resolving tasks: a scene with a goal or a body."""

from __future__ import annotations

from skillc_compiler.program.typed import Task
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.nodes import resolve_node
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_dsl import syntax as s


def resolve_task(context: FileContext, written: s.TaskDeclaration) -> Task:
    """Return the resolved task."""
    scope = Scope(f"the task `{written.name.text}`")
    return Task(
        name=written.name.text,
        doc=written.doc,
        scene=written.scene.value if written.scene else None,
        goal=resolve_condition(context, scope, written.goal) if written.goal is not None else None,
        goal_text=written.goal_text,
        body=resolve_node(context, scope, written.body.node)[0] if written.body else None,
        name_span=written.name.span,
        span=written.span,
    )
