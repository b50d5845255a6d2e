"""Finds the individuals that a goal needs, backward over atoms from the goal: the cheapest plan needs no others.

An atom is *needed* if the goal or a condition of a helpful step reads it; a step is *helpful* if it makes a needed atom
true, or makes one false that is needed to be false and that was true at first or that a helpful step makes true. Remove
all other steps from a plan. By induction, each atom that is needed to be true and was true before a step is still true,
since no removed step made it true; and each that is needed to be false and was false is still false: no step that
remains ever makes it true, or else no removed step made it false. So the rest is a plan, and it costs no more.

Where it is not known exactly what is true at first, more counts as true; so more steps may count as helpful than are.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Set
from typing import TypeAlias, assert_never

from skillc_model.pddl.domain import (
    Action,
    ClassMeaning,
    ExclusionMeaning,
    GoalMeaning,
    GuardMeaning,
    MovedMeaning,
    PlanningDomain,
    PropertyMeaning,
    RelationMeaning,
)
from skillc_model.pddl.formulas import (
    Atom,
    Change,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    conjunction,
)
from skillc_runtime.planning.problem.static_bindings import (
    MAX_STEPS,
    StaticBindings,
    TooManySteps,
    TypedIndividuals,
    Values,
)
from skillc_runtime.world.state.world_state import WorldState

MAX_PATTERNS = 100_000

Fact: TypeAlias = tuple[str, tuple[str, ...]]
"""A predicate and individuals (IRIs)."""

_Pattern: TypeAlias = tuple[str, tuple[str | None, ...]]
"""A predicate and individuals, or None for any."""


def find_needed_individuals(
    domain: PlanningDomain, state: WorldState, goal: Formula, individuals: TypedIndividuals
) -> Set[str] | None:
    """Return the individuals of all helpful steps; the goal names individuals by their IRIs. None if there are many."""
    try:
        return _Regression(domain, state, individuals).run(goal)
    except TooManySteps:
        return None


class _Regression:
    def __init__(self, domain: PlanningDomain, state: WorldState, individuals: TypedIndividuals) -> None:
        self._domain, self._state, self._individuals = domain, state, individuals
        self._fits = individuals.fits
        self._constants = {each.name: domain.names[each.name] for each in domain.constants}
        self._makers: dict[tuple[str, bool], list[tuple[Action, Change]]] = defaultdict(list)
        for action in domain.actions:
            for change in action.effects:
                self._makers[change.atom.predicate, change.positive].append((action, change))
        self._conditions = {each.name: conjunction((each.precondition, each.hold)) for each in domain.actions}
        self._bindings = StaticBindings(domain, state, individuals, self._conditions)
        self._steps: set[tuple[str, tuple[str, ...]]] = set()
        self._needed: set[tuple[bool, _Pattern]] = set()
        self._denied: dict[str, list[_Pattern]] = defaultdict(list)
        self._made_true: dict[str, set[Fact]] = defaultdict(set)
        self._undone: set[Fact] = set()
        self._found: set[str] = set()
        self._open: list[tuple[bool, _Pattern]] = []
        self._to_undo: list[Fact] = []

    def run(self, goal: Formula) -> Set[str]:
        """Return the individuals of all helpful steps."""
        self._need(goal, {})
        while self._open or self._to_undo:
            if self._open:
                sign, pattern = self._open.pop()
                (self._achieve if sign else self._avoid)(pattern)
            else:
                self._undo(self._to_undo.pop())
        return self._found

    def _need(self, formula: Formula, values: Mapping[str, str | None]) -> None:
        """Add what a condition reads to what is needed; quantified variables have the value None."""
        match formula:
            case Atom():
                self._need_atom(formula, values, True)
            case Negation(Atom() as atom):
                self._need_atom(atom, values, False)
            case Equal() | Negation():
                pass
            case Conjunction(parts) | Disjunction(parts):
                for part in parts:
                    self._need(part, values)
            case Existential(variable, body) | Universal(variable, body):
                self._need(body, {**values, variable.name: None})
            case _:
                assert_never(formula)

    def _need_atom(self, atom: Atom, values: Mapping[str, str | None], sign: bool) -> None:
        if not self._domain.predicate[atom.predicate].changes:
            return
        pattern = atom.predicate, tuple(self._value(each, values) for each in atom.terms)
        if (sign, pattern) in self._needed:
            return
        if len(self._needed) > MAX_PATTERNS:
            raise TooManySteps
        self._needed.add((sign, pattern))
        self._open.append((sign, pattern))

    def _value(self, term: str, values: Mapping[str, str | None]) -> str | None:
        return values[term] if term in values else self._constants.get(term, term)

    def _achieve(self, pattern: _Pattern) -> None:
        """Add the steps that make an atom of a pattern true."""
        for action, change in self._makers[pattern[0], True]:
            self._add_steps(action, change, pattern)

    def _avoid(self, pattern: _Pattern) -> None:
        """Add the steps that make an atom of a pattern false, if it is true at first or helpful steps make it true."""
        self._denied[pattern[0]].append(pattern)
        self._to_undo += self._true_at_first(pattern)
        self._to_undo += (fact for fact in self._made_true[pattern[0]] if _matches(pattern, fact))

    def _undo(self, fact: Fact) -> None:
        if fact not in self._undone:
            self._undone.add(fact)
            self._found.update(fact[1])
            for action, change in self._makers[fact[0], False]:
                self._add_steps(action, change, fact)

    def _add_steps(self, action: Action, change: Change, pattern: _Pattern) -> None:
        """Add the steps of an action whose effect may be an atom of a pattern."""
        start = self._unify(action, change, pattern)
        if start is None:
            return
        for values in self._bindings.extend(action, start):
            key = action.name, tuple(values[each.name] for each in action.parameters)
            if key not in self._steps:
                if len(self._steps) >= MAX_STEPS:
                    raise TooManySteps
                self._steps.add(key)
                self._found.update(values.values())
                self._add_step(action, values)

    def _unify(self, action: Action, change: Change, pattern: _Pattern) -> Values | None:
        types = {each.name: each.type for each in (*action.parameters, *change.variables)}
        values: Values = {}
        for term, individual in zip(change.atom.terms, pattern[1], strict=True):
            if individual is None:
                continue
            if term not in types:
                if self._constants.get(term, term) != individual:
                    return None
            elif values.setdefault(term, individual) != individual or not self._fits(individual, types[term]):
                return None
        parameters = {each.name for each in action.parameters}
        return {term: individual for term, individual in values.items() if term in parameters}

    def _add_step(self, action: Action, values: Values) -> None:
        self._need(self._conditions[action.name], values)
        for change in action.effects:
            if change.positive:
                if change.variables:
                    raise TooManySteps
                individuals = tuple(self._value(each, values) or "" for each in change.atom.terms)
                self._make_true((change.atom.predicate, individuals))
            if change.positive or change.apart is None:
                scope = {**values, **dict.fromkeys((each.name for each in change.variables), None)}
                self._need(change.condition, scope)
                self._need_opposite(change.condition, scope)

    def _need_opposite(self, condition: Formula, values: Mapping[str, str | None]) -> None:
        """Need what a condition of an effect reads with the opposite sign: the effect may apply in one plan only."""
        match condition:
            case Atom():
                self._need_atom(condition, values, False)
            case Negation(Atom() as atom):
                self._need_atom(atom, values, True)
            case Equal() | Negation():
                pass
            case Conjunction(parts) | Disjunction(parts):
                for part in parts:
                    self._need_opposite(part, values)
            case Existential(variable, body) | Universal(variable, body):
                self._need_opposite(body, {**values, variable.name: None})
            case _:
                assert_never(condition)

    def _make_true(self, fact: Fact) -> None:
        known = self._made_true[fact[0]]
        if fact not in known:
            known.add(fact)
            if any(_matches(pattern, fact) for pattern in self._denied[fact[0]]):
                self._to_undo.append(fact)

    def _true_at_first(self, pattern: _Pattern) -> Iterator[Fact]:
        """Yield the atoms of a pattern that may be true at first."""
        name, individuals = pattern
        meaning = self._domain.predicate[name].meaning
        match meaning:
            case RelationMeaning(relation=relation):
                subject, object_ = individuals
                yield from ((name, pair) for pair in self._state.pairs(relation, subject, object_))
            case PropertyMeaning(property=iri, value=value):
                owners = self._state.individuals_with(iri, value) if individuals[0] is None else individuals
                yield from ((name, (each,)) for each in owners if each is not None)
            case ClassMeaning() | GuardMeaning() | GoalMeaning() | MovedMeaning() | ExclusionMeaning():
                return
            case _:
                assert_never(meaning)


def _matches(pattern: _Pattern, fact: Fact) -> bool:
    return all(one is None or one == other for one, other in zip(pattern[1], fact[1], strict=True))
