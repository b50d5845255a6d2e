"""Understanding `verify` lines: the skills, conditions and forces they speak of."""

from __future__ import annotations

from skillc_compiler.program.typed import Event, Measured, Property
from skillc_compiler.program.types import Measure, describe, fits
from skillc_compiler.resolve.conditions import clause
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_compiler.resolve.values import ExpectedType, value
from skillc_dsl import syntax as s
from skillc_dsl.units import FORCE

MEASURED = "force"
"""The name of the measured contact force, where no parameter of that name is meant."""


def verified(context: FileContext, scope: Scope, written: s.Verify, text: str) -> Property | None:
    """Return what a property means; None where a skill in it is unknown."""
    first = _event(context, scope, written.first)
    second = _event(context, scope, written.second) if written.second is not None else None
    if first is None or (second is None and written.second is not None):
        return None
    return Property(written.pattern, first, second, text, written.span)


def _event(context: FileContext, scope: Scope, written: s.Event) -> Event | None:
    match written.what:
        case s.Name() as name:
            skill = context.names.skill(name)
            return Event(written.span, skill=skill) if skill is not None else None
        case s.Compare(left=s.Reference(name=name), operator=operator, right=right) if _is_force(scope, name):
            limit = value(context, scope, right, ExpectedType(Measure(FORCE)))
            if not fits(context.vocabulary, limit.type, Measure(FORCE)):
                message = f"this is {describe(limit.type)}, where a Force is expected"
                context.report("wrong-type", limit.span, message, "a force has a unit, such as `25 N`")
            return Event(written.span, measured=Measured(operator, limit))
        case _:
            return Event(written.span, clause=clause(context, scope, written.what))


def _is_force(scope: Scope, name: s.Name) -> bool:
    return name.text == MEASURED and MEASURED not in scope.variables
