"""The planning problem as typed data, which the runtime fills from a snapshot of the world."""

from __future__ import annotations

from fractions import Fraction

import msgspec

from skillc_model.pddl.domain import FixedCost, PlanningDomain
from skillc_model.pddl.formulas import Atom, Formula, Typed


class CostValue(msgspec.Struct, frozen=True):
    """The cost of one tuple of objects, in seconds."""

    function: str
    arguments: tuple[str, ...]
    seconds: Fraction


class Problem(msgspec.Struct, frozen=True):
    """A planning problem of a domain.

    Every object occurs once, with its most specific type; `names` maps object names to IRIs. `goal` is ground: atoms,
    their negations, conjunctions and disjunctions, without quantifiers.
    """

    name: str
    domain: PlanningDomain
    objects: tuple[Typed, ...]
    names: dict[str, str]
    init: tuple[Atom, ...]
    costs: tuple[CostValue, ...]
    goal: Formula


def action_durations(problem: Problem) -> frozenset[Fraction]:
    """Return the durations of the actions of a problem, in seconds."""
    fixed = {each.cost.seconds for each in problem.domain.actions if isinstance(each.cost, FixedCost)}
    return frozenset(fixed | {each.seconds for each in problem.costs})
