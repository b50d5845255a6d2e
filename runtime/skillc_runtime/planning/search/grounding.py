"""Grounds a problem: the actions without variables that may apply, their conditions reduced to what can change.

The reachable atoms are computed with deletions ignored.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import TypeAlias, assert_never

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
from skillc_runtime.planning.search.bindings import Bindings
from skillc_runtime.planning.search.fact_index import FactIndex
from skillc_runtime.planning.search.ground_actions import ActionSchema, GroundAction, GroundEffect
from skillc_runtime.planning.typed_variables import list_typed_variables

Values: TypeAlias = Mapping[str, str]
_Words: TypeAlias = tuple[str, ...]
"""The name of an action and its arguments."""
_PartKey: TypeAlias = tuple[int, tuple[str, ...]]
"""Which part of the condition of an action, and the objects that it reads."""


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
        self._facts = FactIndex(problem.init)
        self._bindings = Bindings(self._facts, self._members)
        self._possible: set[_PartKey] = set()
        self._reduced: dict[_PartKey, Formula] = {}

    @cached_property
    def actions(self) -> tuple[GroundAction, ...]:
        """All ground actions that may apply; computing them completes `reachable`.

        What can never be true is left out of their preconditions: nested quantifiers would have very many parts.
        """
        found, bound, reachable = self._unconditional
        return tuple(self._complete(found[words], bound[words], reachable) for words in sorted(found))

    @property
    def applicable(self) -> Mapping[_Words, GroundAction]:
        """The actions by their names and arguments, without their preconditions, which take as long to find."""
        return self._unconditional[0]

    @cached_property
    def _unconditional(self) -> tuple[dict[_Words, GroundAction], dict[_Words, Values], frozenset[Atom]]:
        """The actions without their preconditions, the values of their variables, and what they reach."""
        found: dict[_Words, GroundAction] = {}
        bound: dict[_Words, Values] = {}
        waiting = {words: values for action in self._schemas.values() for words, values in self._bind_all(action)}
        while True:
            known, size = self._facts.count, (len(self.reachable), len(self._deletable))
            for words, values in tuple(waiting.items()):
                self._cancel.check()
                schema = self._schemas[words[0]]
                if self._can_start(schema, values):
                    bound[words] = waiting.pop(words)
                    effects = (
                        each for change in schema.action.effects for each in self._ground_effects(change, values)
                    )
                    units = self._units(schema.action, values)
                    found[words] = GroundAction(words, TRUE, tuple(effects), units)
                    self._add_reachable(found[words])
            for ground in found.values():
                if any(each.condition != TRUE for each in ground.effects):
                    self._add_reachable(ground)
            if size == (len(self.reachable), len(self._deletable)):
                break
            waiting.update((words, values) for words, values in self._bind_new(known) if words not in found)
        return found, bound, frozenset(self.reachable)

    @cached_property
    def _schemas(self) -> dict[str, ActionSchema]:
        return {each.name: ActionSchema.of(each) for each in self._problem.domain.actions}

    def _bind_all(self, schema: ActionSchema) -> Iterator[tuple[tuple[str, ...], Values]]:
        for values in self._bindings.extend(schema.action, list(schema.atoms), {}):
            self._cancel.check()
            yield schema.words(values), values

    def _bind_new(self, known: int) -> Iterator[tuple[tuple[str, ...], Values]]:
        """Yield the bindings in which an atom is one of the facts that are new after the first `known` ones."""
        for predicate, terms in self._facts.since(known):
            for schema in self._schemas.values():
                for number, atom in enumerate(schema.atoms):
                    if atom.predicate != predicate:
                        continue
                    self._cancel.check()
                    matched = self._bindings.match(atom, terms, {}, schema.types)
                    rest = [*schema.atoms[:number], *schema.atoms[number + 1 :]]
                    for values in () if matched is None else self._bindings.extend(schema.action, rest, matched):
                        yield schema.words(values), values

    def _can_start(self, schema: ActionSchema, values: Values) -> bool:
        """Whether the condition of an action can be true; what was once possible remains so."""
        if not all(self.can_hold(each, values) for each in schema.atoms):
            return False
        for part, read in schema.others:
            key = id(part), tuple(values[each] for each in read)
            if key not in self._possible:
                if not self.can_hold(part, values):
                    return False
                self._possible.add(key)
        return True

    def _complete(self, ground: GroundAction, values: Values, reachable: Collection[Atom]) -> GroundAction:
        """Return a ground action with its precondition, of which what is not reachable is left out."""
        schema = self._schemas[ground.words[0]]
        parts = [self.reduce(each, values, reachable) for each in schema.atoms]
        for part, read in schema.others:
            key = id(part), tuple(values[each] for each in read)
            if key not in self._reduced:
                self._reduced[key] = self.reduce(part, values, reachable)
            parts.append(self._reduced[key])
        return replace(ground, precondition=conjunction(parts))

    def explore(self) -> None:
        """Compute `reachable` with the effects of all actions."""
        every = (each for action in self.applicable.values() for each in action.effects)
        self.reachable.update(each.atom for each in every if each.positive)

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
            case Equal(left, right):
                return values.get(left, left) == values.get(right, right)
            case Negation(body):
                return self._can_fail(body, values)
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

    def _can_fail(self, formula: Formula, values: Values) -> bool:
        """Whether a formula, its variables bound, can be false with the reachable atoms, each by itself."""
        match formula:
            case Atom(predicate, terms):
                atom = Atom(predicate, tuple(values.get(term, term) for term in terms))
                return atom not in self._static and (atom not in self.init or atom in self._deletable)
            case Equal(left, right):
                return values.get(left, left) != values.get(right, right)
            case Negation(body):
                return self.can_hold(body, values)
            case Conjunction(parts):
                return any(self._can_fail(part, values) for part in parts)
            case Disjunction(parts):
                return all(self._can_fail(part, values) for part in parts)
            case Existential(variable, body) | Universal(variable, body):
                self._cancel.check()
                each = (self._can_fail(body, {**values, variable.name: name}) for name in self._members[variable.type])
                return all(each) if isinstance(formula, Existential) else any(each)
            case _:
                assert_never(formula)

    def find_bindings(self, action: Action, conditions: Sequence[Formula], start: Values) -> Iterator[dict[str, str]]:
        """Yield the bindings of an action's parameters that extend `start` and make the conditions reachable."""
        whole = conjunction(conditions)
        atoms = [each for each in conjuncts(whole) if isinstance(each, Atom)]
        bindings = self._bindings.extend(action, atoms, dict(start))
        yield from (values for values in bindings if self.can_hold(whole, values))

    def find_partners(self, atom: Atom, variable: str, values: Values) -> Iterator[str]:
        """Yield the values of a variable with which an atom is reachable, whose other variables have `values`."""
        for terms in self._facts.of(atom.predicate):
            pairs = [(values.get(term, term), name) for term, name in zip(atom.terms, terms, strict=True)]
            fitting = {name for term, name in pairs if term == variable}
            if len(fitting) == 1 and all(term in (name, variable) for term, name in pairs):
                yield from fitting

    def _reduce_atom(self, atom: Atom, within: Collection[Atom] | None) -> Formula:
        if atom.predicate not in self._changing:
            return TRUE if atom in self._static else FALSE
        return atom if within is None or atom in within else FALSE

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

    def _add_reachable(self, ground: GroundAction) -> None:
        """Add the atoms that an action makes true, and those that it makes false."""
        possible = [each for each in ground.effects if self.is_possible(each.condition)]
        new = {each.atom for each in possible if each.positive} - self.reachable
        gone = {each.atom for each in possible if not each.positive} - self._deletable
        self.reachable |= new
        self._deletable |= gone
        for atom in sorted(new, key=lambda each: each.terms):
            self._facts.add(atom)

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
