"""A refinement that does not narrow the description."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Parameter, Refinement
from skillc_compiler.program.types import describe_type, fits
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.rewriting import constant_number
from skillc_model.rounding import is_above

NAMES = ("not-narrower",)
NEEDS = Need.TYPES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each refinement that widens or replaces a type or range."""
    for implementation in program.implementations:
        for new in implementation.refinements:
            if new.of is None:
                continue
            if not fits(program.vocabulary, new.type, new.of.type):
                yield _problem(new, new.of, f"{describe_type(new.type)} is not always {describe_type(new.of.type)}")
            elif new.type == new.of.type and _is_wider(new, new.of):
                yield _problem(new, new.of, "the range goes beyond that of the description")


def _problem(new: Refinement, of: Parameter, reason: str) -> Diagnostic:
    return Diagnostic(
        "not-narrower",
        new.written.type.span if "range" not in reason or new.written.range is None else new.written.range.span,
        f"a refinement of `{of.name}` may only narrow it, but {reason}",
        help="use a subclass or a smaller range, or change the description",
        labels=(Label(of.span, "the description"),),
    )


def _is_wider(new: Refinement, of: Parameter) -> bool:
    low, high, old_low, old_high = (_number(v) for v in (new.low, new.high, of.low, of.high))
    below = low is not None and old_low is not None and is_above(old_low, low)
    above = high is not None and old_high is not None and is_above(high, old_high)
    return below or above


def _number(value: TypedExpression | None) -> float | None:
    return constant_number(value.meaning) if value else None
