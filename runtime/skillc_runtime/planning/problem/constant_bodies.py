"""Decides for which individuals that no step involves the bodies of quantifiers are constant.

Leaving such an individual out changes no condition if the body is false for it below `exists`, true below `forall`.
Atoms about it that are false at first stay false, since only a step that involves it makes them true.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias, assert_never

from skillc_model.pddl.domain import PlanningDomain, PropertyMeaning, RelationMeaning
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    atoms,
)
from skillc_runtime.planning.problem.irrelevant_types import simplify_for
from skillc_runtime.world.state.world_state import WorldState

_Types: TypeAlias = Mapping[str, str]
_Signature: TypeAlias = frozenset[tuple[str, int, str]]
"""The facts about an individual: predicate, its place in it, and the type of the other one."""


class ConstantBodies:
    """The quantified formulas of a domain; `type_of` returns the type of an individual."""

    def __init__(self, domain: PlanningDomain, state: WorldState, type_of: Callable[[str], str]) -> None:
        self._domain, self._state, self._type_of = domain, state, type_of
        constants = {each.name: each.type for each in domain.constants}
        self._quantified: list[tuple[Existential | Universal, _Types]] = []
        for action in domain.actions:
            types = {**constants, **{each.name: each.type for each in action.parameters}}
            for change in action.effects:
                inner = {**types, **{each.name: each.type for each in change.variables}}
                self._quantified += _find_quantified(change.condition, inner)
            for condition in (action.precondition, action.hold):
                self._quantified += _find_quantified(condition, types)
        read = {atom.predicate for each, _ in self._quantified for atom in atoms(each)}
        self._read = [each for each in domain.predicates if each.name in read]
        self._known: dict[tuple[str, _Signature], bool] = {}

    def are_for(self, individual: str) -> bool:
        """Whether the body of every quantifier that ranges over the individual is constant for it."""
        key = self._type_of(individual), frozenset(self._facts(individual))
        if key not in self._known:
            self._known[key] = all(self._is_constant(each, types, *key) for each, types in self._quantified)
        return self._known[key]

    def _facts(self, individual: str) -> Iterator[tuple[str, int, str]]:
        for predicate in self._read:
            match predicate.meaning:
                case RelationMeaning(relation=relation):
                    for side, partners in (
                        (0, self._state.objects(individual, relation)),
                        (1, self._state.subjects(relation, individual)),
                    ):
                        yield from ((predicate.name, side, each) for each in set(map(self._type_of, partners)))
                case PropertyMeaning(property=iri) if self._state.vocabulary.properties[iri].computed_by is None:
                    if self._state.value(individual, iri) is not None:
                        yield predicate.name, 0, ""
                case _:
                    yield predicate.name, 0, ""

    def _is_constant(
        self, quantified: Existential | Universal, types: _Types, type_: str, signature: _Signature
    ) -> bool:
        variable = quantified.variable
        if not self._domain.is_a(type_, variable.type):
            return True

        def may_hold(atom: Atom) -> bool:
            return any(
                name == atom.predicate
                and atom.terms[side] == variable.name
                and all(
                    self._meet(types[term], other) for place, term in enumerate(atom.terms) if place != side and other
                )
                for name, side, other in signature
            )

        body = simplify_for(quantified.body, variable.name, may_hold)
        return body == (FALSE if isinstance(quantified, Existential) else TRUE)

    def _meet(self, one: str, other: str) -> bool:
        return self._domain.is_a(one, other) or self._domain.is_a(other, one)


def _find_quantified(formula: Formula, types: _Types) -> Iterator[tuple[Existential | Universal, _Types]]:
    """Yield the quantified parts of a formula, with the types of all their variables."""
    match formula:
        case Existential(variable, body) | Universal(variable, body):
            inner = {**types, variable.name: variable.type}
            below = list(_find_quantified(body, inner))
            yield formula, {name: type_ for _, known in below for name, type_ in known.items()} | inner
            yield from below
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from _find_quantified(part, types)
        case Atom() | Equal() | Negation():
            return
        case _:
            assert_never(formula)
