"""`-=`, `+=` and `:=` outside posts, and amounts with which a number leaves its range in any case."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.expressions import NumberChange, TypedCondition, TypedExpression
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_model.conditions import And, Forall
from skillc_model.rewriting import constant_number
from skillc_model.rounding import is_above
from skillc_rdf.vocabulary.types import Bounds

NAMES = ("misplaced-change", "change-out-of-range")
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each change of a number that is no effect of a post, or that no number allows."""
    posts = (each for each in program.requirements if each.says_what_comes)
    effects = {id(part) for post in posts for part in _effects(post.condition)}
    for each in program.conditions:
        if each.change is not None and id(each) not in effects:
            yield _misplaced(each, each.change)
        elif each.change is not None:
            yield from _check_amounts(each.change)


def _effects(condition: TypedCondition) -> Iterator[TypedCondition]:
    """Yield the conjuncts of a post, and those of its effects on many."""
    yield condition
    if condition.conditional is not None:
        yield from _effects(condition.parts[0])
    elif isinstance(condition.meaning, And | Forall):
        for part in condition.parts:
            yield from _effects(part)


def _misplaced(condition: TypedCondition, change: NumberChange) -> Diagnostic:
    amount = change.low
    compares = change.operator == ":=" and amount is not None and amount is change.high
    gap = change.of.span.gap(amount.span) if compares and amount is not None else None
    return Diagnostic(
        "misplaced-change",
        condition.span,
        f"`{change.operator}` changes a number, and only a `post` says what a skill changes",
        help="compare with `==`, `<=` or `>=`" if compares else "write it in a `post`, and here what has to hold",
        fix=Fix(gap, " == ", "compare with `==`") if gap is not None else None,
    )


def _check_amounts(change: NumberChange) -> Iterator[Diagnostic]:
    """Report a constant that is outside the range, or by which no number within it can be changed."""
    for value in dict.fromkeys(each for each in (change.low, change.high) if each is not None):
        number = constant_number(value.meaning)
        if number is not None and change.bounds is not None and _leaves(number, change.operator, change.bounds):
            yield _out_of_range(value, change.operator)


def _leaves(number: float, operator: str, bounds: Bounds) -> bool:
    if bounds.least is None or bounds.greatest is None:
        return False
    if operator == ":=":
        return is_above(bounds.least, number) or is_above(number, bounds.greatest)
    return is_above(abs(number), bounds.greatest - bounds.least)


def _out_of_range(value: TypedExpression, operator: str) -> Diagnostic:
    what = "this is outside the range of the property" if operator == ":=" else "after this no number is in its range"
    return Diagnostic("change-out-of-range", value.span, what, help="choose a value within the declared range")
