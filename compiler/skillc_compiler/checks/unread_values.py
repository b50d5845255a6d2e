"""A name in braces, in a text that is passed as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, TypedNode
from skillc_compiler.program.types import MESSAGE
from skillc_compiler.program.walk import implementation_values, node_values, nodes_in, values_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_model.conditions import Literal

NAMES = ("unread-value",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION
_NAME = re.compile(r"(?<!\{)\{([^\W\d]\w*)(?:\.[^\W\d]\w*)?\}(?!\})")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each name in braces that is known where its text stands."""
    for implementation in program.implementations:
        known = frozenset(_names(implementation))
        for value in _values(implementation):
            if value.type != MESSAGE and isinstance(value.meaning, Literal) and isinstance(value.meaning.value, str):
                yield from _unread(value.meaning.value, value.span, known)


def _unread(text: str, span: Span, known: frozenset[str]) -> Iterator[Diagnostic]:
    for found in _NAME.finditer(text):
        if found[1] in known:
            column = span.column + 1 + found.start()
            place = Span(span.path, span.line, column, span.line, column + len(found[0]))
            message = f"`{found[0]}` stands for no value here: this text is passed as it is"
            help_ = "only the reason of `fail` and what is a `Message` have values in them"
            yield Diagnostic("unread-value", place, message, help_, severity="warning")


def _names(implementation: Implementation) -> Iterator[str]:
    """Yield the names that have a value somewhere in an implementation."""
    yield from (each.name for each in implementation.parameters)
    yield from (each.name.text for each in implementation.lets)
    for node in _nodes(implementation):
        if node.call is not None and node.call.out is not None:
            yield node.call.out.text
        if isinstance(node.written, s.For):
            yield node.written.variable.text
        if isinstance(node.written, s.OnFailure) and node.written.why is not None:
            yield node.written.why.text


def _values(implementation: Implementation) -> Iterator[TypedExpression]:
    inside = (value for node in _nodes(implementation) for value in node_values(node))
    return (part for value in (*implementation_values(implementation), *inside) for part in values_in(value))


def _nodes(implementation: Implementation) -> Iterator[TypedNode]:
    if isinstance(implementation.body, TypedNode):
        yield from nodes_in(implementation.body)
