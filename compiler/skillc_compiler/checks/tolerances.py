"""Tolerances of what is sensed: where they stand, and what they are."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import NumberChange, TypedCondition
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Requirement
from skillc_compiler.program.types import INT, Measure, Type
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.units import NUMBER, TEMPERATURE, TEMPERATURE_DIFFERENCE, Dimension, dimension_of

NAMES = ("misplaced-tolerance", "bad-tolerance")
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each tolerance of what is no sensed change of a number, or that is none of that number."""
    for requirement in program.requirements:
        if requirement.tolerance is not None:
            yield from _check(requirement, requirement.tolerance)


def _check(requirement: Requirement, written: s.Number | s.Quantity) -> Iterator[Diagnostic]:
    changes = tuple(_changes(requirement.condition))
    if not requirement.sensed or requirement.kind != "post" or not changes:
        message = "nothing is computed here from which what is sensed could differ"
        help_ = "write it behind `post sensed thing.property -= AMOUNT`, or `+=`, or `:=`"
        yield Diagnostic("misplaced-tolerance", written.span, message, help_)
        return
    for change in changes:
        problem = _problem(change.of.type, written)
        if problem is not None:
            yield Diagnostic("bad-tolerance", written.span, *problem)
            return


def _changes(condition: TypedCondition) -> Iterator[NumberChange]:
    if condition.change is not None:
        yield condition.change
    for part in condition.parts:
        yield from _changes(part)


def _problem(kind: Type, written: s.Number | s.Quantity) -> tuple[str, str] | None:
    """Return what is wrong with a tolerance of a number of a type, and what to write."""
    if written.value < 0:
        return "no number is this near to another one", "write a number that is not negative"
    of = NUMBER if kind == INT else kind.dimension if isinstance(kind, Measure) else None
    if of is None:
        return None
    if isinstance(written, s.Quantity) and written.unit == "%":
        share = "a share of a temperature depends on where its zero is"
        return (share, "write a difference, such as `5 K`") if of == TEMPERATURE else None
    needed = TEMPERATURE_DIFFERENCE if of == TEMPERATURE else of
    given = dimension_of(written.unit) if isinstance(written, s.Quantity) else NUMBER
    return None if given == needed else _unlike(given, needed)


def _unlike(given: Dimension, needed: Dimension) -> tuple[str, str]:
    message = f"this is a {given.name}, and the number is a {needed.name}" if given != NUMBER else "it has no unit"
    return message, "write it in the unit of the number, or as a share of it, such as `5 %`"
