"""Blocks without steps."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Span

NAMES = ("empty-block",)
NEEDS = Need.TYPES
READS = Reads.DECLARATION

_LAST = (s.OnFailure, s.Finally)
"""What ends with the braces that are empty."""


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield an error for each node with empty braces."""
    removable = {child.written.span for node in program.nodes for child in node.children if len(node.children) > 1}
    for node in program.nodes:
        found = _describe_empty(node.written)
        if found is not None:
            span = node.written.span
            fix = Fix(span, "", "delete it", safe=False) if span in removable and "else" not in found[0] else None
            place = _last_brace(span) if isinstance(node.written, _LAST) else _first_line(span)
            yield Diagnostic("empty-block", place, found[0], help=found[1], fix=fix)


def _describe_empty(node: s.Node) -> tuple[str, str] | None:
    """Return the message and help for a node without steps; None if it has steps, or no braces."""
    match node:
        case s.If(then=(), text=text):
            return "nothing is done if this condition holds", f"write `if not ({text}) {{ .. }}`, or add a step"
        case s.If(orelse=()):
            return "this `else` has no steps", "remove it, or add a step"
        case s.OnFailure(handler=()):
            return "nothing is done on failure", "write `try { .. }`, or add a step"
        case s.Finally(last=()):
            return "nothing is done at the end", "remove `finally`, or add a step"
        case s.Block(kind=kind, children=()) | s.Decorator(kind=kind, children=()):
            return f"this `{kind}` has no steps", "add a step, or remove it"
        case s.While(children=()) | s.For(children=()) | s.With(children=()):
            return f"this `{type(node).__name__.lower()}` has no steps", "add a step, or remove it"
    return None


def _last_brace(span: Span) -> Span:
    return Span(span.path, span.end_line, span.end_column - 1, span.end_line, span.end_column)


def _first_line(span: Span) -> Span:
    """Return the first line of a node, at most."""
    if span.end_line == span.line:
        return span
    return Span(span.path, span.line, span.column, span.line, span.column + 1)
