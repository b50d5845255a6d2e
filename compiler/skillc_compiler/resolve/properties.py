"""Resolving `verify` lines: their skills, conditions and forces."""

from __future__ import annotations

from skillc_compiler.program.typed import ForceLimit, Property, VerifyEvent
from skillc_compiler.program.types import Measure, describe_type, fits
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_compiler.resolve.values import ExpectedType, resolve_value
from skillc_dsl import syntax as s
from skillc_dsl.units import FORCE

FORCE_NAME = "force"
"""The name of the measured contact force, unless a parameter has that name."""


def resolve_verify(context: FileContext, scope: Scope, written: s.Verify, text: str) -> Property | None:
    """Return the resolved `verify` line, or None if a skill in it is unknown."""
    first = _event(context, scope, written.first)
    second = _event(context, scope, written.second) if written.second is not None else None
    if first is None or (second is None and written.second is not None):
        return None
    return Property(written.pattern, first, second, text, written.span)


def _event(context: FileContext, scope: Scope, written: s.VerifyEvent) -> VerifyEvent | None:
    match written.what:
        case s.Name() as name:
            skill = context.names.look_up_skill(name)
            return VerifyEvent(written.span, skill=skill) if skill is not None else None
        case s.Compare(left=s.NameReference(name=name), operator=operator, right=right) if _is_force(scope, name):
            limit = resolve_value(context, scope, right, ExpectedType(Measure(FORCE)))
            if not fits(context.vocabulary, limit.type, Measure(FORCE)):
                message = f"this is {describe_type(limit.type)}, where a Force is expected"
                context.report("wrong-type", limit.span, message, "a force has a unit, such as `25 N`")
            return VerifyEvent(written.span, measured=ForceLimit(operator, limit))
        case _:
            return VerifyEvent(written.span, condition=resolve_condition(context, scope, written.what))


def _is_force(scope: Scope, name: s.Name) -> bool:
    return name.text == FORCE_NAME and FORCE_NAME not in scope.variables
