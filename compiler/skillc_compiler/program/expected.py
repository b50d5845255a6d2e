"""Places where a value of a certain type is expected, with the value that stands there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillc_compiler.program.typed import Call, Parameter, Program, Refinement, TypedExpression
from skillc_compiler.program.types import UNKNOWN, ListOf, Measure, Type, of_library
from skillc_compiler.program.walk import calls, steps, values
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_dsl.units import TIME
from skillc_model.conditions import Invoke

SECONDS = Measure(TIME)


@dataclass(frozen=True, slots=True)
class Place:
    """A value and the type expected of it; `by` reads on from "is expected", `cause` is where that is said."""

    value: TypedExpression
    wanted: Type
    by: str
    cause: Span | None = None


def places(program: Program) -> Iterator[Place]:
    """Yield every place where a type is expected of a value."""
    for skill in program.skills.values():
        for parameter in skill.parameters:
            yield from _head(parameter, parameter.name, parameter.span)
        yield from _seconds(skill.duration, "by `duration`")
    for implementation in program.implementations:
        for new in implementation.refinements:
            yield from _head(new, new.written.name.text, new.written.name.span)
        yield from _seconds(implementation.duration, "by `duration`")
    for call in calls(program):
        yield from arguments(call)
    for step in steps(program):
        match step.written:
            case s.Timeout() | s.Wait():
                yield from _seconds(step.values[0], "as time")
            case s.For():
                yield Place(step.values[0], ListOf(UNKNOWN), "to go through")
            case _:
                pass
    for value in values(program):
        if isinstance(value.meaning, Invoke):
            yield from _applied(program, value, value.meaning)


def arguments(call: Call) -> Iterator[Place]:
    """Yield the arguments of a call that a parameter takes."""
    for argument in call.arguments:
        parameter = call.skill.parameter(argument.name.text) if call.skill else None
        if call.skill and parameter:
            by = f"by the parameter `{parameter.name}` of `{call.skill.name}`"
            yield Place(argument.value, parameter.type, by, parameter.span)


def _head(parameter: Parameter | Refinement, name: str, declared: Span) -> Iterator[Place]:
    if parameter.default is not None:
        yield Place(parameter.default, parameter.type, f"as the default of `{name}`", declared)
    for bound in (parameter.low, parameter.high):
        if bound is not None:
            yield Place(bound, parameter.type, f"as a bound of `{name}`", declared)


def _seconds(value: TypedExpression | None, by: str) -> Iterator[Place]:
    if value is not None:
        yield Place(value, SECONDS, by)


def _applied(program: Program, value: TypedExpression, meaning: Invoke) -> Iterator[Place]:
    function = program.vocabulary.functions.get(meaning.function)
    if function is None:
        return
    for argument, (name, kind) in zip(value.parts, function.parameters, strict=False):
        yield Place(argument, of_library(kind), f"by `{name}` of the function `{function.name}`")
