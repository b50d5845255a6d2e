"""Hints in the lines of a file: types that are not written, parameters that are inferred, implementations chosen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, TypeAlias

import msgspec

from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.term_pages import format_bare_type
from skillc_compiler.program.typed import Call, TypedNode
from skillc_compiler.program.types import UNKNOWN, ListOf, Measure, Type, Vector, declared_as, describe_type
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_model.format_type import SI_UNITS


class CallChoice(msgspec.Struct, frozen=True):
    """How a call goes in a scene: its place, the implementation, and the individuals of its inferred parameters."""

    line: int
    column: int
    implementation: str
    inferred: tuple[tuple[str, str], ...]


Choices: TypeAlias = Mapping[tuple[int, int], CallChoice]
"""The choices of calls by their line and column."""


class Hint(msgspec.Struct, frozen=True):
    """A text that is shown before a column of a line, both from 1, and what it says in more words."""

    line: int
    column: int
    text: str
    about: str
    kind: Literal["type", "parameter", "choice"]


def find_hints(analysis: Analysis, path: str, lines: range, chosen: Choices) -> Iterator[Hint]:
    """Yield the hints in some lines of a file, from 1; `chosen` are the choices of calls in its tasks and tests."""
    for implementation in analysis.program.implementations:
        if implementation.span.path == path and _meets(implementation.span, lines):
            lets = ((let.name, let.value.type) for let in implementation.lets)
            yield from (_type(name, kind) for name, kind in lets if name.span.line in lines and kind != UNKNOWN)
            if isinstance(implementation.body, TypedNode):
                yield from _in_body(analysis, implementation.body, lines, {})
    for task in analysis.program.tasks:
        if task.body is not None and task.body.written.span.path == path:
            yield from _in_body(analysis, task.body, lines, chosen)


def _in_body(analysis: Analysis, body: TypedNode, lines: range, chosen: Choices) -> Iterator[Hint]:
    for node in nodes_in(body):
        if node.written.span.line > lines.stop or node.written.span.end_line < lines.start:
            continue
        if isinstance(node.written, s.For) and node.values and isinstance(node.values[0].type, ListOf):
            yield _type(node.written.variable, node.values[0].type.element)
        if node.call is not None and node.call.skill is not None:
            yield from _at_call(analysis, node.call, chosen)


def _at_call(analysis: Analysis, call: Call, chosen: Choices) -> Iterator[Hint]:
    assert call.skill is not None, "the skill is known"
    written = call.written
    choice = chosen.get((written.span.line, written.span.column))
    ways = analysis.program.implementations_of.get(call.skill.name, ())
    if choice is not None and written.implementation is None and len(ways) > 1:
        about = f"in this scene, `{choice.implementation}` is the implementation of `{call.skill.name}` that is chosen"
        name = written.skill.span
        yield Hint(name.end_line, name.end_column, f"[{choice.implementation}]", about, "choice")
    passed = {argument.name.text for argument in call.arguments}
    found = dict(choice.inferred) if choice is not None else {}
    left = [each for each in call.skill.parameters if each.direction == "infer" and each.name not in passed]
    if left and (choice is None or found):
        yield _inferred(analysis, call, [each.name for each in left], found)
    outputs = [each.type for each in call.skill.parameters if each.direction == "out"]
    if written.out is not None and outputs:
        yield _type(written.out, outputs[0])


def _inferred(analysis: Analysis, call: Call, names: Sequence[str], found: Mapping[str, str]) -> Hint:
    values = [f"{name}: {found[name]}" if name in found else f"{name}: .." for name in names]
    line, column = _closing(analysis, call.written)
    text = f", {', '.join(values)}" if call.arguments else ", ".join(values)
    about = "inferred from the preconditions" + (", in this scene" if found else " when the call starts")
    return Hint(line, column, text, about, "parameter")


def _closing(analysis: Analysis, written: s.CallSkill) -> tuple[int, int]:
    """Return the place of the parenthesis that closes the arguments of a call."""
    end = written.out.span if written.out is not None else None
    line, column = (end.line, end.column) if end is not None else (written.span.end_line, written.span.end_column)
    before = analysis.line(written.span.path, line)[: column - 1]
    return line, before.rfind(")") + 1 or column


def _type(name: s.Name, kind: Type) -> Hint:
    declared = declared_as(kind)
    text = describe_type(kind) if declared is None else format_bare_type(declared)
    unit = SI_UNITS.get(kind.dimension.name, "") if isinstance(kind, Measure | Vector) else ""
    shown = f": {text} in {unit}" if unit else f": {text}"
    return Hint(name.span.end_line, name.span.end_column, shown, f"`{name.text}` is {describe_type(kind)}", "type")


def _meets(span: Span, lines: range) -> bool:
    return span.line < lines.stop and span.end_line >= lines.start
