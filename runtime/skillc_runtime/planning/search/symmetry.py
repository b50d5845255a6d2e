"""Finds interchangeable objects of a problem, and one state for all that differ only in which of them is which.

Objects are interchangeable if exchanging any two of them changes neither what never changes, nor costs, nor the goal;
where they are at first does not matter. From states that differ only in this, plans of the same cost lead to the goal,
so a search may keep one of them (Pochter, Zohar and Rosenschein, "Exploiting problem symmetries in state-based
planners", 2011; here the symmetries are exchanges of two objects only).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import TypeAlias

from skillc_model.pddl.domain import Action, ComputedCost
from skillc_model.pddl.formulas import (
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    conjuncts,
    rename_terms,
)
from skillc_model.pddl.problem import CostValue, Problem

_Stated: TypeAlias = Formula | CostValue


class Symmetry:
    """Groups of interchangeable objects in states in which bit n is set if atom n is true."""

    def __init__(self, groups: tuple[tuple[str, ...], ...], numbers: Mapping[Atom, int]) -> None:
        self._groups, self._numbers = groups, numbers
        self._atoms = {number: atom for atom, number in numbers.items()}
        self._masks = tuple(
            sum(1 << number for atom, number in numbers.items() if not set(group).isdisjoint(atom.terms))
            for group in groups
        )

    def canonical(self, state: int) -> int:
        """Return a state that differs from this one only in which of interchangeable objects is which.

        It is often the same for all of them: in each group the objects are in the order of what is true of them.
        """
        for group, mask in zip(self._groups, self._masks, strict=True):
            state = self._sort(state, group, mask)
        return state

    def _sort(self, state: int, group: tuple[str, ...], mask: int) -> int:
        concerned = [self._atoms[number] for number in _bits(state & mask)]
        about: dict[str, list[tuple[str, ...]]] = {each: [] for each in group}
        for atom in concerned:
            for term in atom.terms:
                if term in about:
                    about[term].append((atom.predicate, *("" if each == term else each for each in atom.terms)))
        order = sorted(group, key=about.__getitem__)
        if order == [*group]:
            return state
        names = dict(zip(order, group, strict=True))
        renamed = (Atom(each.predicate, tuple(names.get(term, term) for term in each.terms)) for each in concerned)
        numbers = [self._numbers.get(each) for each in renamed]
        if None in numbers:
            return state  # what no action makes true of another one
        return state & ~mask | sum(1 << number for number in numbers if number is not None)


def find_symmetry(problem: Problem, numbers: Mapping[Atom, int]) -> Symmetry | None:
    """Return the interchangeable objects of a problem, as far as the atoms `numbers` are about them; None if none."""
    changing = {each.atom.predicate for action in problem.domain.actions for each in action.effects}
    named = {term for action in problem.domain.actions for term in _terms_of(action)}
    stated: dict[str, set[_Stated]] = defaultdict(set)
    for each in (*(atom for atom in problem.init if atom.predicate not in changing), *conjuncts(problem.goal)):
        for term in _terms(each):
            stated[term].add(each)
    for cost in problem.costs:
        for term in cost.arguments:
            stated[term].add(cost)
    moved = {term for atom in numbers for term in atom.terms}
    groups: list[list[str]] = []
    types = {each.name: each.type for each in problem.objects}
    for name in sorted(types.keys() & moved - named):
        alike = (each for each in groups if types[each[0]] == types[name])
        group = next((each for each in alike if _exchangeable(each[0], name, stated)), None)
        if group is None:
            groups.append([name])
        else:
            group.append(name)
    found = tuple(tuple(each) for each in groups if len(each) > 1)
    return Symmetry(found, numbers) if found else None


def _exchangeable(one: str, other: str, stated: Mapping[str, set[_Stated]]) -> bool:
    ours, theirs = stated.get(one, set()), stated.get(other, set())
    if len(ours) != len(theirs):
        return False
    names, both = {one: other, other: one}, ours | theirs
    return all(_exchange(each, names) in both for each in both)


def _exchange(stated: _Stated, names: Mapping[str, str]) -> _Stated:
    if isinstance(stated, CostValue):
        return CostValue(stated.function, tuple(names.get(each, each) for each in stated.arguments), stated.seconds)
    return rename_terms(stated, names)


def _terms_of(action: Action) -> Iterator[str]:
    """Yield the objects and variables in an action."""
    yield from (*_terms(action.precondition), *_terms(action.hold), *action.uses)
    for each in action.effects:
        yield from (*each.atom.terms, *_terms(each.condition))
    if isinstance(action.cost, ComputedCost):
        yield from action.cost.arguments


def _terms(formula: Formula) -> Iterator[str]:
    match formula:
        case Atom(_, terms):
            yield from terms
        case Equal(left, right):
            yield from (left, right)
        case Negation(body) | Existential(_, body) | Universal(_, body):
            yield from _terms(body)
        case Conjunction(parts) | Disjunction(parts):
            for each in parts:
                yield from _terms(each)


def _bits(number: int) -> Iterator[int]:
    while number:
        low = number & -number
        yield low.bit_length() - 1
        number ^= low
