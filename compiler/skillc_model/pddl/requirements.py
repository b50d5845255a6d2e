"""The `:requirements` of a domain: those its actions use, in the order of the PDDL definition."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_model.pddl.domain import PlanningDomain
from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal

ORDER = (
    ":strips",
    ":typing",
    ":negative-preconditions",
    ":disjunctive-preconditions",
    ":equality",
    ":existential-preconditions",
    ":universal-preconditions",
    ":conditional-effects",
    ":action-costs",
)


def find_requirements(domain: PlanningDomain) -> tuple[str, ...]:
    """Return the requirements of the classical domain."""
    used = {":strips", ":typing", ":action-costs"}
    for action in domain.actions:
        used |= set(_of(action.precondition)) | set(_of(action.hold))
        for change in action.effects:
            used |= {":conditional-effects"} if change.variables else set()
            used |= set(_of(change.condition))
    return tuple(each for each in ORDER if each in used)


def _of(formula: Formula) -> Iterator[str]:
    match formula:
        case Atom():
            pass
        case Equal():
            yield ":equality"
        case Negation(body=body):
            yield ":negative-preconditions"
            yield from _of(body)
        case Conjunction(parts=parts):
            yield from (each for part in parts for each in _of(part))
        case Disjunction(parts=parts):
            yield ":disjunctive-preconditions"
            yield from (each for part in parts for each in _of(part))
        case Existential(body=body):
            yield ":existential-preconditions"
            yield from _of(body)
        case Universal(body=body):
            yield ":universal-preconditions"
            yield from _of(body)
        case _:
            assert_never(formula)
