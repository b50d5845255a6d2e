"""Lists the typed variables of a domain. Objects of other types do not affect what is reachable."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_model.pddl.domain import PlanningDomain
from skillc_model.pddl.formulas import (
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
)


def list_typed_variables(domain: PlanningDomain) -> Iterator[Typed]:
    """Yield the parameters and the quantified variables of all actions."""
    for action in domain.actions:
        yield from action.parameters
        for formula in (action.precondition, action.hold, *(change.condition for change in action.effects)):
            yield from _list_quantified(formula)
        for change in action.effects:
            yield from change.variables


def _list_quantified(formula: Formula) -> Iterator[Typed]:
    match formula:
        case Existential(variable, body) | Universal(variable, body):
            yield variable
            yield from _list_quantified(body)
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from _list_quantified(part)
        case Atom() | Equal() | Negation():
            return
        case _:
            assert_never(formula)
