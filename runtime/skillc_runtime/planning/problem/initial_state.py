"""The initial state of a planning problem: its facts, its static conditions for every tuple, and its costs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from fractions import Fraction
from itertools import product
from math import prod
from typing import assert_never

from skillc_model.conditions import Expression
from skillc_model.pddl.costs import ASSUMED_SECONDS, exact_seconds
from skillc_model.pddl.domain import (
    ClassMeaning,
    CostFunction,
    ExclusionMeaning,
    GoalMeaning,
    GuardMeaning,
    MovedMeaning,
    PlanningDomain,
    Predicate,
    PropertyMeaning,
    RelationMeaning,
)
from skillc_model.pddl.formulas import Atom, Typed
from skillc_model.pddl.problem import CostValue
from skillc_runtime.cancellation import check_current
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value, has_value
from skillc_runtime.world.state.world_state import WorldState

MAX_VALUES = 1_000_000
CHECKED_AFTER = 256
"""After how many combinations it is asked whether there is time left."""


class TooManyValues(Exception):
    """A condition or a duration has too many combinations of arguments to evaluate it for all of them."""


Cost = tuple[str, tuple[str, ...]]
"""A cost function with its arguments."""


class InitialState:
    """Reads a version of the world for a planner.

    `undecided` collects the conditions that cannot be evaluated for some individuals; they count as false for these.
    `untimed` is why a duration has no value, by cost function and arguments; `ASSUMED_SECONDS` is taken instead.
    """

    def __init__(self, domain: PlanningDomain, state: WorldState, objects: Sequence[Typed], names: dict[str, str]):
        self._domain, self._state = domain, state
        self._iris = names
        self._names = {iri: name for name, iri in names.items()}
        self._members = {type_: domain.of_type(objects, type_) for type_ in _parameter_types(domain)}
        self.undecided: dict[str, None] = {}
        self.untimed: dict[Cost, str] = {}

    def atoms(self) -> Iterator[Atom]:
        """Yield the atoms that are true initially, sorted within each predicate."""
        for predicate in self._domain.predicates:
            yield from (Atom(predicate.name, terms) for terms in sorted(self._true_tuples(predicate)))

    def costs(self) -> Iterator[CostValue]:
        """Yield the value of each cost function for all arguments of its types."""
        for function in self._domain.costs:
            for names in self._arguments(function.parameters, f"the duration of {function.skill}"):
                yield CostValue(function.name, names, self._duration_s(function, names))

    def _true_tuples(self, predicate: Predicate) -> Iterable[tuple[str, ...]]:
        match predicate.meaning:
            case RelationMeaning(relation, narrower):
                return self._related_pairs(relation, narrower)
            case PropertyMeaning(property_, value):
                return ((self._names[iri],) for iri in self._with_value(property_, value))
            case ClassMeaning(cls):
                return ((name,) for iri, name in self._names.items() if self._state.is_a(iri, cls))
            case GuardMeaning():
                return self._satisfying(predicate, predicate.meaning)
            case GoalMeaning() | MovedMeaning():
                return ()
            case ExclusionMeaning(steps):
                return (tuple(map(self._names.__getitem__, step)) for step in steps)
            case _:
                assert_never(predicate.meaning)

    def _related_pairs(self, relation: str, narrower: tuple[tuple[str, bool], ...]) -> set[tuple[str, ...]]:
        names, others = self._names, {each for each, _ in narrower}
        pairs = (
            self._state.pairs(relation)
            if self._state.vocabulary.is_computed(relation)
            else self._asserted_pairs(relation, others)
        )
        return {(names[start], names[end]) for start, end in pairs if start in names and end in names}

    def _asserted_pairs(self, relation: str, others: Set[str]) -> Iterator[tuple[str, str]]:
        """Yield the pairs between which a relation holds because of asserted relations that are not among the others.

        A transitive relation counts with its closure, unless skills change one of its sources.
        """
        axioms, closure = self._state.axioms, self._state.vocabulary.closure
        for source, flipped in axioms.sources[relation]:
            deep = source in axioms.transitive and not any(
                each.relation in others for each in closure.canonical_sources[source]
            )
            if deep or closure.canonical(source).relation not in others:
                links = (self._state.facts if deep else self._state.asserted)[source]
                found = links.backward if flipped else links.forward
                yield from ((start, end) for start in self._names for end in found.get(start))

    def _with_value(self, property_: str, value: bool | str) -> Iterator[str]:
        state, term = self._state, self._state.vocabulary.properties[property_]
        computed = term.computed_by is not None
        owners = (iri for iri in self._names if not computed or any(state.is_a(iri, each) for each in term.domains))
        return (iri for iri in owners if has_value(property_of(state, iri, property_), value))

    def _satisfying(self, predicate: Predicate, fact: GuardMeaning) -> Iterator[tuple[str, ...]]:
        for names in self._arguments(predicate.parameters, f"condition `{fact.label}` of {fact.skill}"):
            bindings = {variable: self._iris[name] for variable, name in zip(fact.variables, names, strict=True)}
            try:
                if evaluate(fact.condition, self._state, bindings):
                    yield names
            except EvaluationError as error:
                self.undecided[f"condition `{fact.label}` of {fact.skill}: {error}"] = None

    def _arguments(self, parameters: Sequence[Typed], reader: str) -> Iterator[tuple[str, ...]]:
        members = [self._members[each.type] for each in parameters]
        if prod(map(len, members)) > MAX_VALUES:
            sizes = " x ".join(str(len(each)) for each in members if len(each) > 1)
            raise TooManyValues(f"{reader} would have to be evaluated for {sizes} objects")
        for count, names in enumerate(product(*members)):
            if count % CHECKED_AFTER == 0:
                check_current()
            yield names

    def _duration_s(self, function: CostFunction, names: tuple[str, ...]) -> Fraction:
        bindings = {variable: self._iris[name] for variable, name in zip(function.variables, names, strict=True)}
        seconds = evaluate_duration_s(function.expression, self._state, bindings)
        if isinstance(seconds, Fraction):
            return seconds
        self.untimed[function.name, names] = f"duration of {function.skill}: {seconds}"
        return ASSUMED_SECONDS


def evaluate_duration_s(
    expression: Expression, state: WorldState, bindings: Mapping[str, Value | None]
) -> Fraction | str:
    """Return a duration in s, or why it has no value; callers then take `ASSUMED_SECONDS`."""
    try:
        return exact_seconds(value_of(expression, state, bindings))
    except (EvaluationError, ValueError) as reason:
        return str(reason)


def _parameter_types(domain: PlanningDomain) -> set[str]:
    typed = [each for predicate in domain.predicates for each in predicate.parameters]
    return {each.type for each in (*typed, *(each for function in domain.costs for each in function.parameters))}
