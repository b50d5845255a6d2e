"""Implementations and tasks without a body, and tasks with one whose plan is to have little of something."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Task, Test
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span

NAMES = ("missing-body", "minimise-without-goal")
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each missing body, and for each body that is to be planned."""
    for implementation in program.implementations:
        if implementation.body is None:
            yield Diagnostic(
                "missing-body",
                implementation.name_span,
                f"the implementation `{implementation.name}` has no body",
                help='add `do seq { .. }` or `run python "module:Class"`',
                labels=(Label(_last_line(implementation.span), "add it before this `}`"),),
            )
    for task in program.tasks:
        yield from _task(task)


def _last_line(span: Span) -> Span:
    return Span(span.path, span.end_line, span.end_column - 1, span.end_line, span.end_column)


def _task(task: Task) -> Iterator[Diagnostic]:
    if (task.goal is None) == (task.body is None):
        both, kind = task.goal is not None, "test" if isinstance(task, Test) else "task"
        yield Diagnostic(
            "missing-body",
            task.name_span,
            f"the {kind} `{task.name}` has {'both a goal and a body' if both else 'neither a goal nor a body'}",
            help="write either `goal CONDITION` or `do NODE`",
            labels=() if both else (Label(_last_line(task.span), "add it before this `}`"),),
        )
    elif task.minimise is not None and task.body is not None:
        yield Diagnostic(
            "minimise-without-goal",
            task.minimise.span,
            "a task with a body is not planned, so there is nothing to minimise",
            help="delete the line, or write `goal CONDITION` in place of `do NODE`",
        )
