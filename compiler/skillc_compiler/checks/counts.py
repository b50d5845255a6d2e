"""Counts, times and other numbers that are out of range."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from skillc_compiler.logic.intervals import Interval, interval_of, parameter_intervals
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_model.conditions import Arithmetic, Literal
from skillc_model.rewriting import constant_number
from skillc_model.tree import MOST_ROUNDS

NAMES = ("bad-count", "bad-time", "bad-number")
NEEDS = Need.TEXT
READS = Reads.DECLARATION
MOST = 1e100
"""The largest quantity that is accepted; larger numbers only overflow."""
LARGEST_INTEGER = 2**53 - 1
"""The largest integer that a double represents exactly."""
YEAR_S = 366 * 24 * 3600.0


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each invalid count, time and number."""
    yield from _times(program)
    for value in program.values:
        yield from _number(value)


def _count(count: Interval, span: Span, text: str) -> Iterator[Diagnostic]:
    """Yield a problem if no number, or if one that is stated, is a number of rounds."""
    low, high = count
    if high < 1 or low > MOST_ROUNDS or (low == high and low != int(low)):
        message = f"`{text}` is not a valid number of rounds"
        yield Diagnostic("bad-count", span, message, help="write a whole number, 1 or more, at most a million")


def _times(program: Program) -> Iterator[Diagnostic]:
    for skill in program.skills.values():
        if skill.duration:
            yield from _time(skill.duration, parameter_intervals(skill.parameters), "duration")
        if skill.cost:
            yield from _cost(skill.cost, parameter_intervals(skill.parameters))
        if skill.pause and skill.pause.keep:
            yield from _time(skill.pause.keep, {}, "keep")
    for implementation in program.implementations:
        known = parameter_intervals(implementation.parameters, implementation.lets)
        if implementation.duration:
            yield from _time(implementation.duration, known, "duration")
        if isinstance(implementation.body, TypedNode):
            yield from _in_body(nodes_in(implementation.body), known)
    for task in program.tasks:
        if task.within:
            yield from _time(task.within, {}, "within")
        if task.body:
            yield from _in_body(nodes_in(task.body), {})


def _in_body(nodes: Iterable[TypedNode], known: Mapping[str, Interval]) -> Iterator[Diagnostic]:
    for node in nodes:
        match node.written:
            case s.Decorator(kind=kind, row=row, slots=slots):
                for value, slot, written in zip(node.values, row.slots, slots, strict=True):
                    yield from _time(value, known, kind) if slot.kind == "time" else _rounds(value, known, written)
            case s.While(limit=limit):
                yield from _rounds(node.values[0], known, limit)
            case s.Wait():
                yield from _time(node.values[0], known, "wait")
            case _:
                pass


def _rounds(value: TypedExpression, known: Mapping[str, Interval], written: s.Value) -> Iterator[Diagnostic]:
    found = interval_of(value.meaning, known)
    if found is not None:
        low, high = found
        text = written.text if isinstance(written, s.Number) else f"{low:g} to {high:g}"
        yield from _count(found, value.span, text)


def _time(value: TypedExpression, known: Mapping[str, Interval], word: str) -> Iterator[Diagnostic]:
    found = interval_of(value.meaning, known)
    if found is None:
        return
    low, high = found
    if high < 0:
        yield _bad_time(value.span, f"a `{word}` of {high:g} s is negative", "write a time of 0 s or more")
    elif high == 0 and word == "timeout":
        yield _bad_time(value.span, "the time is up at once, so what is in it never runs", "write a time above 0 s")
    elif high == 0 and word == "within":
        yield _bad_time(value.span, "the time is up at once, so the task always fails", "write a time above 0 s")
    elif YEAR_S < low <= MOST:
        yield _bad_time(value.span, f"a `{word}` of {low:g} s is longer than a year", "write a shorter time")


def _cost(value: TypedExpression, known: Mapping[str, Interval]) -> Iterator[Diagnostic]:
    found = interval_of(value.meaning, known)
    if found is not None and found[1] < 0:
        yield Diagnostic(
            "bad-number", value.span, f"a `cost` of {found[1]:g} is negative", "write a number of 0 or more"
        )


def _bad_time(span: Span, message: str, help_: str) -> Diagnostic:
    return Diagnostic("bad-time", span, message, help_)


def _number(value: TypedExpression) -> Iterator[Diagnostic]:
    match value.meaning:
        case Literal(value=int() as found) if not -LARGEST_INTEGER <= found <= LARGEST_INTEGER:
            yield Diagnostic("bad-number", value.span, "this number is too large", "write a smaller number")
        case Literal(value=float() as found) if abs(found) > MOST:
            yield Diagnostic("bad-number", value.span, "this number is too large", "write a smaller number")
        case Arithmetic(operator="/", right=right) if constant_number(right) == 0:
            yield Diagnostic("bad-number", value.span, "this divides by zero", "divide by something else")
        case Arithmetic() as sum_ if all(_is_finite(constant_number(part.meaning)) for part in value.parts):
            if not _is_finite(constant_number(sum_)):
                message = "the result is too large a number"
                yield Diagnostic("bad-number", value.span, message, "write smaller numbers")


def _is_finite(found: float | None) -> bool:
    return found is None or abs(found) <= MOST
