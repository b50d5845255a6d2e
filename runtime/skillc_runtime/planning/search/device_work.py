"""The least time that a device must be at work in any plan: no plan is over before that, whatever runs side by side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from skillc_model.pddl.domain import Action, FixedCost
from skillc_model.pddl.formulas import Equal, Negation, conjunction
from skillc_model.pddl.names import fresh
from skillc_model.pddl.problem import Problem


def price_device_work(problem: Problem, device: str) -> Problem:
    """Return the problem in which only those actions cost anything that lock the device (an object's name).

    No two of them run at the same time, so the cost of its cheapest plan is a time that any plan takes.
    """
    taken = {*problem.domain.names, *problem.domain.action, *problem.domain.predicate}
    actions = tuple(each for action in problem.domain.actions for each in _cases(action, device, taken))
    return replace(problem, domain=replace(problem.domain, actions=actions, constants=problem.objects))


def _cases(action: Action, device: str, taken: set[str]) -> Iterator[Action]:
    """Yield an action that costs nothing for other devices, and the action for this one in each place for a device."""
    others = (Negation(Equal(each, device)) for each in action.uses)
    yield replace(action, precondition=conjunction((action.precondition, *others)), cost=FixedCost(Fraction(0)))
    for each in action.uses:
        here = conjunction((action.precondition, Equal(each, device)))
        name = fresh(f"{action.name}-busy", taken)
        taken.add(name)
        yield replace(action, name=name, precondition=here)
