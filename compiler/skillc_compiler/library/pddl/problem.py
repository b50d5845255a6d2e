"""The typed form of a planning problem: pure data that the runtime fills from a snapshot of the world."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_compiler.library.pddl.domain import PlanningDomain
from skillc_compiler.library.pddl.formulas import Atom, Formula, Typed


@dataclass(frozen=True)
class CostValue:
    """The cost of one tuple of objects, in the domain's units (an integer of at least 1)."""

    function: str
    arguments: tuple[str, ...]
    units: int


@dataclass(frozen=True)
class Problem:
    """A problem of a domain.

    Every object stands once, with its most specific type; `names` leads from object names to IRIs. `goal` is ground:
    atoms, their negations, conjunctions and disjunctions, without quantifiers.
    """

    name: str
    domain: PlanningDomain
    objects: tuple[Typed, ...]
    names: dict[str, str]
    init: tuple[Atom, ...]
    costs: tuple[CostValue, ...]
    goal: Formula
