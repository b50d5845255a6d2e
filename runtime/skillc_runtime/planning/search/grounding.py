"""Grounds a problem: the actions without variables that may apply, their conditions reduced to what can change.

The reachable atoms are computed with deletions ignored.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import TypeAlias, assert_never

import msgspec
from msgspec.structs import replace

from skillc_model.pddl.domain import Action, ComputedCost, FixedCost
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
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
    conjuncts,
    disjunction,
)
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.typed_variables import list_typed_variables

Values: TypeAlias = Mapping[str, str]


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


class Grounding:
    """The ground actions of a problem that relaxed reachability allows.

    Cancelled if `cancel` ends the search before they are found; by default nothing does.
    """

    def __init__(self, problem: Problem, cancel: CancelToken | None = None) -> None:
        self._problem, self._cancel = problem, cancel or CancelToken()
        types = {each.type for each in list_typed_variables(problem.domain)}
        self._members = {type_: problem.domain.of_type(problem.objects, type_) for type_ in types}
        self._costs = {(each.function, each.arguments): each.seconds for each in problem.costs}
        self._changing = {each.atom.predicate for action in problem.domain.actions for each in action.effects}
        self._static = frozenset(each for each in problem.init if each.predicate not in self._changing)
        self.init = frozenset(each for each in problem.init if each.predicate in self._changing)
        self.reachable: set[Atom] = set(self.init)
        self._deletable: set[Atom] = set()
        self._facts: dict[str, list[tuple[str, ...]]] = defaultdict(list)
        for atom in problem.init:
            self._facts[atom.predicate].append(atom.terms)

    @cached_property
    def actions(self) -> tuple[GroundAction, ...]:
        """All ground actions that may apply; computing them completes `reachable`.

        What can never be true is left out of their preconditions: nested quantifiers would have very many parts.
        """
        found: dict[tuple[str, ...], GroundAction] = {}
        bound: dict[tuple[str, ...], tuple[Action, Values]] = {}
        grown = True
        while grown:
            grown = False
            for action in self._problem.domain.actions:
                for ground, values in tuple(self._ground(action, found)):
                    found[ground.words] = ground
                    bound[ground.words] = action, values
                    grown |= self._add_reachable(ground)
        return tuple(self._complete(found[words], *bound[words]) for words in sorted(found))

    def _complete(self, ground: GroundAction, action: Action, values: Values) -> GroundAction:
        """Return a ground action with its precondition; all that is reachable is known."""
        condition = conjunction((action.precondition, action.hold))
        return replace(ground, precondition=self.reduce(condition, values, self.reachable))

    def explore(self) -> None:
        """Compute `reachable` with the effects of all actions."""
        self.reachable.update(each.atom for action in self.actions for each in action.effects if each.positive)

    def goal(self) -> Formula:
        """Return the goal with its static atoms evaluated; FALSE if it can never hold."""
        return self.reduce(self._problem.goal, {})

    def reduce(self, formula: Formula, values: Values, within: Collection[Atom] | None = None) -> Formula:
        """Return a formula with its variables bound, quantifiers expanded and static atoms evaluated.

        Of the others, those that are not `within` these, if given, are never true.
        """
        match formula:
            case Atom(predicate, terms):
                atom = Atom(predicate, tuple(values.get(term, term) for term in terms))
                return self._reduce_atom(atom, within)
            case Equal(left, right):
                return TRUE if values.get(left, left) == values.get(right, right) else FALSE
            case Negation(body):
                return _negate(self.reduce(body, values, within))
            case Conjunction(parts):
                return conjunction(self.reduce(part, values, within) for part in parts)
            case Disjunction(parts):
                return disjunction(self.reduce(part, values, within) for part in parts)
            case Existential(variable, body):
                self._cancel.check()
                names = self._members[variable.type]
                return disjunction(self.reduce(body, {**values, variable.name: name}, within) for name in names)
            case Universal(variable, body):
                self._cancel.check()
                names = self._members[variable.type]
                return conjunction(self.reduce(body, {**values, variable.name: name}, within) for name in names)
            case _:
                assert_never(formula)

    def can_hold(self, formula: Formula, values: Values) -> bool:
        """Whether a formula, its variables bound, can be true with the reachable atoms, deletions ignored."""
        match formula:
            case Atom(predicate, terms):
                atom = Atom(predicate, tuple(values.get(term, term) for term in terms))
                return atom in (self.reachable if predicate in self._changing else self._static)
            case Equal() | Negation():
                return self.is_possible(self.reduce(formula, values))
            case Conjunction(parts):
                return all(self.can_hold(part, values) for part in parts)
            case Disjunction(parts):
                return any(self.can_hold(part, values) for part in parts)
            case Existential(variable, body) | Universal(variable, body):
                self._cancel.check()
                each = (self.can_hold(body, {**values, variable.name: name}) for name in self._members[variable.type])
                return any(each) if isinstance(formula, Existential) else all(each)
            case _:
                assert_never(formula)

    def find_bindings(self, action: Action, conditions: Sequence[Formula], start: Values) -> Iterator[dict[str, str]]:
        """Yield the bindings of an action's parameters that extend `start` and make the conditions reachable."""
        whole = conjunction(conditions)
        bindings = self._bindings(action, conjuncts(whole), start)
        yield from (values for values in bindings if self.can_hold(whole, values))

    def find_partners(self, atom: Atom, variable: str, values: Values) -> Iterator[str]:
        """Yield the values of a variable with which an atom is reachable, whose other variables have `values`."""
        for terms in self._facts[atom.predicate]:
            pairs = [(values.get(term, term), name) for term, name in zip(atom.terms, terms, strict=True)]
            fitting = {name for term, name in pairs if term == variable}
            if len(fitting) == 1 and all(term in (name, variable) for term, name in pairs):
                yield from fitting

    def _bindings(self, action: Action, conditions: Iterable[Formula], start: Values) -> Iterator[dict[str, str]]:
        """Yield the bindings of an action's parameters that make the positive atoms among the conditions reachable."""
        yield from self._bind(action, [each for each in conditions if isinstance(each, Atom)], dict(start))

    def _bind(self, action: Action, atoms: list[Atom], values: dict[str, str]) -> Iterator[dict[str, str]]:
        """Bind parameters by the atom with the most bound terms first, the remaining ones by type."""
        open_ = [each for each in action.parameters if each.name not in values]
        linked = [atom for atom in atoms if any(each.name in atom.terms for each in open_)]
        if not linked:
            for names in product(*(self._members[each.type] for each in open_)):
                yield {**values, **dict(zip((each.name for each in open_), names, strict=True))}
            return
        atom = max(linked, key=lambda each: sum(not term.startswith("?") or term in values for term in each.terms))
        rest = [each for each in atoms if each is not atom]
        types = {each.name: each.type for each in action.parameters}
        for terms in tuple(self._facts[atom.predicate]):
            matched = self._match(atom, terms, values, types)
            if matched is not None:
                yield from self._bind(action, rest, matched)

    def _match(
        self, atom: Atom, terms: tuple[str, ...], values: dict[str, str], types: dict[str, str]
    ) -> dict[str, str] | None:
        matched = dict(values)
        for term, name in zip(atom.terms, terms, strict=True):
            if term in types and term not in matched:
                if name not in self._member_sets[types[term]]:
                    return None
                matched[term] = name
            elif matched.get(term, term) != name:
                return None
        return matched

    @cached_property
    def _member_sets(self) -> dict[str, frozenset[str]]:
        return {type_: frozenset(names) for type_, names in self._members.items()}

    def _reduce_atom(self, atom: Atom, within: Collection[Atom] | None) -> Formula:
        if atom.predicate not in self._changing:
            return TRUE if atom in self._static else FALSE
        return atom if within is None or atom in within else FALSE

    def _ground(
        self, action: Action, known: Mapping[tuple[str, ...], GroundAction]
    ) -> Iterator[tuple[GroundAction, Values]]:
        """Yield the actions that may apply with the atoms that are reachable so far, still without preconditions."""
        condition = conjunction((action.precondition, action.hold))
        for values in self._bindings(action, conjuncts(condition), {}):
            self._cancel.check()
            words = (action.name, *(values[each.name] for each in action.parameters))
            if words in known:
                yield known[words], values
            elif self.can_hold(condition, values):
                effects = tuple(each for change in action.effects for each in self._ground_effects(change, values))
                yield GroundAction(words, TRUE, effects, self._units(action, values)), values

    def is_possible(self, formula: Formula) -> bool:
        """Whether a reduced formula can be true with the reachable atoms, deletions ignored."""
        match formula:
            case Atom():
                return formula in self.reachable
            case Conjunction(parts):
                return all(self.is_possible(part) for part in parts)
            case Disjunction(parts):
                return any(self.is_possible(part) for part in parts)
            case Negation(body):
                return body not in self.init or body in self._deletable
            case Equal() | Existential() | Universal():
                raise AssertionError(f"{formula} is not reduced")
            case _:
                assert_never(formula)

    def _ground_effects(self, change: Change, values: Values) -> Iterator[GroundEffect]:
        for names in product(*(self._members[each.type] for each in change.variables)):
            bound = {**values, **dict(zip((each.name for each in change.variables), names, strict=True))}
            condition = self.reduce(change.condition, bound)
            atom = Atom(change.atom.predicate, tuple(bound.get(term, term) for term in change.atom.terms))
            if condition != FALSE:
                yield GroundEffect(atom, change.positive, condition)

    def _add_reachable(self, ground: GroundAction) -> bool:
        """Add the atoms that an action makes true, and those that it makes false; return whether one was new."""
        possible = [each for each in ground.effects if self.is_possible(each.condition)]
        new = {each.atom for each in possible if each.positive} - self.reachable
        gone = {each.atom for each in possible if not each.positive} - self._deletable
        self.reachable |= new
        self._deletable |= gone
        for atom in sorted(new, key=lambda each: each.terms):
            self._facts[atom.predicate].append(atom.terms)
        return bool(new or gone)

    def _units(self, action: Action, values: Values) -> int:
        match action.cost:
            case FixedCost(seconds):
                return self._problem.domain.units(seconds)
            case ComputedCost(function, arguments):
                return self._problem.domain.units(self._costs[function, tuple(values[each] for each in arguments)])


def _negate(formula: Formula) -> Formula:
    if isinstance(formula, Atom | Equal):
        return Negation(formula)
    return FALSE if formula == TRUE else TRUE
