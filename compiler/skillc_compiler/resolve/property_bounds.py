"""The range of a number that is a property: `property charge(Robot): Energy range 0 Wh .. 100 Wh`."""

from __future__ import annotations

from skillc_compiler.program.types import INT, Measure, Type, describe_type, type_of
from skillc_compiler.resolve.names import Names
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.units import NUMBER, UNITS, to_si
from skillc_rdf.vocabulary.types import Bounds, ValueType


def resolve_bounds(written: s.Range | None, declared: ValueType, names: Names) -> Bounds | None:
    """Return the bounds of a property in SI units; None without a range, or if it is wrong, which is reported."""
    kind = type_of(declared)
    if written is None or not (kind == INT or isinstance(kind, Measure)):
        if written is not None:
            message = f"a range bounds a number, and this is {describe_type(kind)}"
            names.problems.append(Diagnostic("wrong-type", written.span, message, help="remove the range"))
        return None
    low, high = (_constant(each, kind, names) for each in (written.low, written.high))
    if low is None or high is None:
        return None
    if low > high:
        message = "no value is in this range: its lower bound is the greater one"
        names.problems.append(Diagnostic("empty-range", written.span, message, help="write the lower bound first"))
        return None
    return Bounds(least=low, greatest=high)


def _constant(written: s.Value, kind: Type, names: Names) -> float | None:
    match written:
        case s.Number(value=value) if kind in (INT, Measure(NUMBER)):
            return float(value)
        case s.Quantity(value=value, unit=unit) if (
            isinstance(kind, Measure) and UNITS[unit].dimension == kind.dimension
        ):
            return to_si(value, unit)
    message = f"a bound is a constant, here {describe_type(kind)}"
    problem = Diagnostic("wrong-type", written.span, message, help="write a number with its unit, such as `0 N`")
    names.problems.append(problem)
    return None
