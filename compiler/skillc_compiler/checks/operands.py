"""Values that cannot be added, multiplied or compared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.program.arithmetic import arithmetic_type
from skillc_compiler.program.expressions import NumberChange, TypedCondition, TypedExpression
from skillc_compiler.program.labels import label_values
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.types import INT, UNKNOWN, Direction, Measure, Type, Vector, describe_type, fits
from skillc_compiler.resolve.aggregates import aggregate_type
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_dsl.units import TEMPERATURE
from skillc_model.conditions import Aggregate, Arithmetic, Compare

NAMES = ("unlike-dimensions", "wrong-operands")
TEMPERATURES = (
    "a temperature is written in degC and a difference of two in K: add a difference to a temperature, subtract two "
    "temperatures, and multiply differences only"
)
NEEDS = Need.TEXT
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each operation and comparison with incompatible operands."""
    for value in program.values:
        if isinstance(value.meaning, Arithmetic):
            yield from _check_arithmetic(value, value.meaning)
        if isinstance(value.meaning, Aggregate):
            yield from _check_aggregate(value, value.meaning)
    for condition in program.conditions:
        if isinstance(condition.meaning, Compare):
            yield from _check_comparison(program, condition, condition.meaning)
        if condition.change is not None:
            yield from _check_change(program, condition.change)


def _check_arithmetic(value: TypedExpression, meaning: Arithmetic) -> Iterator[Diagnostic]:
    left, right = (part.type for part in value.parts)
    if arithmetic_type(meaning.operator, left, right) is None:
        yield _problem(value.span, meaning.operator, left, right, value.parts)


def _check_aggregate(value: TypedExpression, meaning: Aggregate) -> Iterator[Diagnostic]:
    for each in value.parts:
        if aggregate_type(meaning.function, each.type) is None:
            ordered = meaning.function == "ordered"
            takes = "`by` takes numbers or texts" if ordered else f"`{meaning.function}` takes numbers"
            is_temperature = each.type == Measure(TEMPERATURE)
            yield Diagnostic(
                "wrong-operands",
                each.span,
                "temperatures are not added" if is_temperature else f"{takes}, and this is {describe_type(each.type)}",
                help="write `mean`, or a difference" if is_temperature else "write a property that is a number",
            )


def _check_comparison(program: Program, condition: TypedCondition, meaning: Compare) -> Iterator[Diagnostic]:
    if len(condition.values) != 2:
        return
    left, right = (side.type for side in condition.values)
    if UNKNOWN in (left, right):
        return
    alike = fits(program.vocabulary, left, right) or fits(program.vocabulary, right, left)
    if not alike:
        yield _problem(condition.span, meaning.operator, left, right, condition.values)
    elif meaning.operator not in ("==", "!=") and not (left == INT or isinstance(left, Measure)):
        yield Diagnostic(
            "wrong-operands",
            condition.span,
            f"`{meaning.operator}` compares numbers, and this is {describe_type(left)}",
            help="compare with `==` or `!=`",
        )


def _check_change(program: Program, change: NumberChange) -> Iterator[Diagnostic]:
    of, operator = change.of, change.operator
    if not (of.type in (INT, UNKNOWN) or isinstance(of.type, Measure)):
        message = f"`{operator}` changes numbers, and this is {describe_type(of.type)}"
        yield Diagnostic("wrong-operands", of.span, message, help="say what is so afterwards with `==`")
        return
    for amount in dict.fromkeys(each for each in (change.low, change.high) if each is not None):
        after = amount.type if operator == ":=" else arithmetic_type(operator[0], of.type, amount.type)
        if after is None or not fits(program.vocabulary, after, of.type):
            yield _problem(amount.span, operator, of.type, amount.type, (of, amount))


def _problem(span: Span, operator: str, left: Type, right: Type, sides: Sequence[TypedExpression]) -> Diagnostic:
    unlike = _is_number(left) and _is_number(right)
    return Diagnostic(
        "unlike-dimensions" if unlike else "wrong-operands",
        span,
        f"`{operator}` cannot combine {describe_type(left)} and {describe_type(right)}",
        help=_suggest(left, right) if unlike else "use values of one type",
        labels=label_values(*sides),
    )


def _suggest(left: Type, right: Type) -> str:
    match left, right:
        case (Measure(dimension=dimension), _) | (_, Measure(dimension=dimension)) if dimension == TEMPERATURE:
            return TEMPERATURES
        case Vector() | Direction(), Vector() | Direction():
            return "convert both vectors to one dimension: multiply one by a quantity, as in `5 cm * normal`"
        case (Vector() | Direction(), _) | (_, Vector() | Direction()):
            return "make a vector of the number first, as in `5 cm * normal`"
    return "convert both sides to one dimension"


def _is_number(kind: Type) -> bool:
    return kind == INT or isinstance(kind, Measure | Vector | Direction)
