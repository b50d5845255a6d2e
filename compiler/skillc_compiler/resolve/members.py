"""Resolving what skills and implementations share: requirements, durations, constants."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeVar

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.typed import Requirement
from skillc_compiler.program.types import Measure, Type
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.references import ExpectedType
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_compiler.resolve.values import resolve_value
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.units import NUMBER, TIME

Member = TypeVar("Member", s.Duration, s.Cost, s.Prefer, s.Pause)
CONSTANT_SCOPE = Scope("a default or range, which is a constant,")


def resolve_requirements(
    context: FileContext, before: Scope, after: Scope, members: Sequence[object], labels: dict[str, s.Name]
) -> Iterator[Requirement]:
    """Yield the conditions; posts are resolved in the scope `after`, where outputs have values.

    `labels` holds the labels used so far; new ones are added to it.
    """
    for member in members:
        if isinstance(member, s.Requirement):
            _check_label(context, member, labels)
            scope = after if member.kind in ("post", "possible", "outcome") else before
            yield Requirement(
                member.kind,
                member.label,
                member.sensed,
                resolve_condition(context, scope, member.condition),
                member.text,
                member.span,
                member.likely,
                member.tolerance,
            )


def resolve_senses(context: FileContext, scope: Scope, members: Sequence[object]) -> Iterator[TypedExpression]:
    """Yield what a skill makes known."""
    for member in members:
        if isinstance(member, s.Senses):
            yield resolve_value(context, scope, member.value)


def resolve_duration(context: FileContext, scope: Scope, members: Sequence[object]) -> TypedExpression | None:
    """Return the expected duration; a second one is reported."""
    written = single_member(context, members, s.Duration, "duration")
    return resolve_value(context, scope, written.value, ExpectedType(Measure(TIME))) if written else None


def resolve_cost(context: FileContext, scope: Scope, members: Sequence[object]) -> TypedExpression | None:
    """Return what a skill costs; a second cost is reported."""
    written = single_member(context, members, s.Cost, "cost")
    return resolve_value(context, scope, written.value, ExpectedType(Measure(NUMBER))) if written else None


def single_member(context: FileContext, members: Sequence[object], kind: type[Member], word: str) -> Member | None:
    """Return the member of a kind; further ones are reported."""
    found = [member for member in members if isinstance(member, kind)]
    for extra in found[1:]:
        context.report(
            "duplicate-member",
            extra.span,
            f"there is already a `{word}` here",
            "keep one of them",
            Label(found[0].span, "the first one"),
        )
    return found[0] if found else None


def resolve_constant(context: FileContext, written: s.Value | None, kind: Type) -> TypedExpression | None:
    """Return a default or a bound of a range."""
    return resolve_value(context, CONSTANT_SCOPE, written, ExpectedType(kind)) if written is not None else None


def _check_label(context: FileContext, member: s.Requirement, labels: dict[str, s.Name]) -> None:
    if member.label is None:
        return
    former = labels.setdefault(member.label.text, member.label)
    if former is not member.label:
        context.report(
            "duplicate-label",
            member.label.span,
            f"`{member.label.text}` is already the label of another condition",
            "choose another label",
            Label(former.span, "the other one"),
        )
