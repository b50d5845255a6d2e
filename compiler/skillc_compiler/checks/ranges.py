"""A number outside its declared range, or an empty range."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Parameter
from skillc_compiler.program.types import INT, Measure, Type
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span
from skillc_dsl.units import NUMBER
from skillc_model.format_type import format_quantity
from skillc_model.rewriting import constant_number
from skillc_model.rounding import is_above
from skillc_rdf.vocabulary.types import NumberType

NAMES = ("out-of-range", "empty-range")
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each default, argument and range."""
    for skill in program.skills.values():
        for parameter in skill.parameters:
            yield from _check_empty(parameter)
            yield from _check_outside(parameter, parameter.default)
    for implementation in program.implementations:
        refined = {new.of.name: new for new in implementation.refinements if new.of}
        for parameter in implementation.parameters:
            if parameter.name in refined:
                new = refined[parameter.name]
                yield from _check_empty(parameter)
                yield from _check_outside(parameter, parameter.default, None if new.default else new.written.span)
    for call in program.calls:
        for argument in call.arguments:
            taken = call.skill.parameter(argument.name.text) if call.skill else None
            if taken:
                yield from _check_outside(taken, argument.value)


def _check_empty(parameter: Parameter) -> Iterator[Diagnostic]:
    low, high = _bounds(parameter)
    if low is not None and high is not None and low > high and parameter.low and parameter.high:
        yield Diagnostic(
            "empty-range",
            parameter.low.span.to(parameter.high.span),
            f"no value is in this range: {_format_si(low, parameter.type)} is more than "
            f"{_format_si(high, parameter.type)}",
            help="write the lower bound first",
        )


def _check_outside(
    parameter: Parameter, value: TypedExpression | None, place: Span | None = None
) -> Iterator[Diagnostic]:
    """Report a constant outside the range, at `place` or else at the value."""
    low, high = _bounds(parameter)
    known = _number(value, parameter.type)
    if (
        value is None
        or known is None
        or not isfinite(known)
        or low is None
        or high is None
        or low > high
        or not (is_above(low, known) or is_above(known, high))
    ):
        return
    bounds = f"{_format_si(low, parameter.type)} .. {_format_si(high, parameter.type)}"
    yield Diagnostic(
        "out-of-range",
        place or value.span,
        f"`{parameter.name}` is {_format_si(known, parameter.type)} here, outside its range {bounds}",
        help=f"choose a value in {bounds}" if place is None else f"give a default in {bounds}",
        labels=(Label(parameter.low.span, "the range"),) if parameter.low else (),
    )


def _bounds(parameter: Parameter) -> tuple[float | None, float | None]:
    return _number(parameter.low, parameter.type), _number(parameter.high, parameter.type)


def _number(value: TypedExpression | None, kind: Type) -> float | None:
    """Return a bound, None if there is none or if its type is wrong, which is reported elsewhere."""
    return constant_number(value.meaning) if value and _is_same_type(value.type, kind) else None


def _is_same_type(given: Type, wanted: Type) -> bool:
    match given, wanted:
        case Measure(dimension=one), Measure(dimension=other):
            return one.join(other) is not None
    return given == wanted or (given == INT and wanted == Measure(NUMBER))


def _format_si(si: float, kind: Type) -> str:
    """Return a number in SI units with its unit."""
    return format_quantity(si, NumberType(kind.dimension.name)) if isinstance(kind, Measure) else f"{si:g}"
