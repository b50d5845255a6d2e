"""Actions without variables, and the schemas that they are made from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import assert_never

import msgspec

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import (
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    conjunction,
    conjuncts,
)


class GroundEffect(msgspec.Struct, frozen=True):
    """The atom becomes true (`positive`) or false if the condition held before."""

    atom: Atom
    positive: bool
    condition: Formula


class GroundAction(msgspec.Struct, frozen=True):
    """An action with its objects, as `words`; its formulas have neither variables nor static atoms. Costs `units`."""

    words: tuple[str, ...]
    precondition: Formula
    effects: tuple[GroundEffect, ...]
    units: int


class ActionSchema(msgspec.Struct, frozen=True):
    """An action and the parts of its condition: those that are atoms, and others with the parameters that they read."""

    action: Action
    atoms: tuple[Atom, ...]
    others: tuple[tuple[Formula, tuple[str, ...]], ...]
    types: dict[str, str]

    @classmethod
    def of(cls, action: Action) -> ActionSchema:
        """Return the parts of the condition of an action."""
        parts = conjuncts(conjunction((action.precondition, action.hold)))
        types = {each.name: each.type for each in action.parameters}
        atoms = tuple(each for each in parts if isinstance(each, Atom))
        others = (each for each in parts if not isinstance(each, Atom))
        return cls(
            action, atoms, tuple((each, tuple(sorted(_find_terms(each) & types.keys()))) for each in others), types
        )

    def words(self, values: Mapping[str, str]) -> tuple[str, ...]:
        """Return the name of the action and its objects."""
        return self.action.name, *(values[each.name] for each in self.action.parameters)


def _find_terms(formula: Formula) -> set[str]:
    match formula:
        case Atom(_, terms):
            return set(terms)
        case Equal(left, right):
            return {left, right}
        case Negation(body) | Existential(_, body) | Universal(_, body):
            return _find_terms(body)
        case Conjunction(parts) | Disjunction(parts):
            return set().union(*map(_find_terms, parts))
        case _:
            assert_never(formula)
