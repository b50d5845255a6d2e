"""A lower bound on the duration of every plan of a scene, from a problem as small as one for a part of the scene.

All individuals of a type that were left out are merged into one *abstract object*. Every plan of the scene maps to a
plan of the abstraction, step by step: atoms about kept objects are unchanged; atoms about an abstract object are never
deleted, so they hold whenever they hold for one of its members; a negated atom about an abstract object is assumed to
hold; and a duration that depends on one is the least of its members'. So no plan of the scene is shorter than the
shortest plan of the abstraction, and the scene has no plan if the abstraction has none.

Axioms make the bound tighter: asserting a functional relation deletes all other values.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from math import prod
from typing import assert_never

from skillc_model.pddl.costs import ASSUMED_SECONDS
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
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.problem import CostValue, Problem
from skillc_runtime.planning.abstraction.relaxation import DomainRelaxation, NotRelaxable
from skillc_runtime.planning.problem.initial_state import TooManyValues, evaluate_duration_s
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import has_value
from skillc_runtime.world.state.world_state import WorldState

MAX_TUPLES = 100_000


def relax_scene(posed: PosedProblem, state: WorldState) -> Problem | None:
    """Return the abstract problem, whose shortest plan is no longer than any plan of the whole scene.

    The IRI of an abstract object is the first of its members'. None if the problem is not narrowed, if the goal is
    open, if a conditional effect cannot be relaxed, or if there are too many facts about abstract objects.
    """
    if not posed.narrowed or posed.open_goal:
        return None
    problem = posed.problem
    relaxation = DomainRelaxation(problem.domain, problem.goal, posed.library.vocabulary)
    try:
        return _Abstraction(posed, state).problem(relaxation.relax_domain(), relaxation)
    except (NotRelaxable, TooManyValues):
        return None


class _Abstraction:
    def __init__(self, posed: PosedProblem, state: WorldState) -> None:
        self._posed, self._state = posed, state
        taken = {*posed.problem.names, *posed.problem.domain.names}
        self._abstract = tuple(Typed(make_unique(f"other-{type_}", taken), type_) for type_ in sorted(posed.others))
        self._members = {each.name: posed.others[each.type] for each in self._abstract}
        self._objects = tuple(sorted((*posed.problem.objects, *self._abstract), key=lambda each: each.name))
        self._kept_names = {iri: name for name, iri in posed.problem.names.items()}
        self._abstract_names: dict[str, str] = {}
        for name, iris in self._members.items():
            self._abstract_names.update(dict.fromkeys(iris, name))

    def problem(self, domain: PlanningDomain, relaxation: DomainRelaxation) -> Problem:
        """Return the problem with the relaxed domain."""
        problem = self._posed.problem
        facts = {atom for predicate in problem.domain.predicates for atom in self._abstract_atoms(predicate)}
        may = {
            Atom(relaxation.may[atom.predicate], atom.terms)
            for atom in (*problem.init, *facts)
            if atom.predicate in relaxation.may
        }
        exactly = {atom for atom in problem.init if atom.predicate in relaxation.negated}
        marks = {Atom(relaxation.mark, (each.name,)) for each in self._abstract}
        return Problem(
            name="bound",
            domain=domain,
            objects=self._objects,
            names={**problem.names, **{name: min(members) for name, members in self._members.items()}},
            init=tuple(sorted(may | exactly | marks, key=lambda each: (each.predicate, each.terms))),
            costs=(*problem.costs, *(value for each in domain.costs for value in self._abstract_costs(each))),
            goal=relaxation.relax(problem.goal),
        )

    def _abstract_atoms(self, predicate: Predicate) -> Iterator[Atom]:
        """Yield the atoms of a predicate about abstract objects that hold for some of their members."""
        match predicate.meaning:
            case RelationMeaning(relation=relation):
                yield from (Atom(predicate.name, pair) for pair in self._related_pairs(relation))
            case PropertyMeaning(property=property_, value=value):
                yield from (Atom(predicate.name, (name,)) for name in self._with_value(property_, value))
            case ClassMeaning(cls=cls):
                found = self._state.instances(cls)
                holding = (name for name, members in self._members.items() if not found.isdisjoint(members))
                yield from (Atom(predicate.name, (name,)) for name in holding)
            case GuardMeaning(variables=(variable,), condition=condition):
                fits = (each.name for each in self._objects_for(predicate.parameters[0]) if each.name in self._members)
                accepted = self._with_some_member(fits, lambda iri: evaluate(condition, self._state, {variable: iri}))
                yield from (Atom(predicate.name, (name,)) for name in accepted)
            case GuardMeaning():
                yield from (Atom(predicate.name, names) for names in self._abstract_arguments(predicate.parameters))
            case GoalMeaning() | MovedMeaning() | ExclusionMeaning():
                return
            case _:
                assert_never(predicate.meaning)

    def _related_pairs(self, relation: str) -> set[tuple[str, str]]:
        """Return the pairs of objects, at least one of them abstract, between which a relation may hold."""
        kept, others = self._kept_names, self._abstract_names
        found = set()
        for subject, object_ in self._state.pairs(relation):
            if subject in others or object_ in others:
                found.add((others.get(subject) or kept.get(subject), others.get(object_) or kept.get(object_)))
        return {(subject, object_) for subject, object_ in found if subject is not None and object_ is not None}

    def _with_value(self, property_: str, value: bool | str) -> Iterable[str]:
        """Return the abstract objects with a member whose property may have a value."""
        if self._state.vocabulary.properties[property_].computed_by is None:
            return {
                self._abstract_names[iri]
                for iri in self._state.individuals_with(property_, value)
                if iri in self._abstract_names
            }
        return self._with_some_member(
            self._members, lambda iri: has_value(property_of(self._state, iri, property_), value)
        )

    def _with_some_member(self, names: Iterable[str], holds: Callable[[str], bool]) -> Iterator[str]:
        """Yield the abstract objects for a member of which a condition holds."""
        return (name for name in names if any(_holds_decidedly(holds, iri) for iri in self._members[name]))

    def _abstract_costs(self, function: CostFunction) -> Iterator[CostValue]:
        for names in self._abstract_arguments(function.parameters):
            least = self._least_duration_s(function, names[0]) if len(names) == 1 else Fraction(0)
            yield CostValue(function.name, names, least)

    def _least_duration_s(self, function: CostFunction, name: str) -> Fraction:
        (variable,) = function.variables
        return min(_duration_s(function, self._state, {variable: iri}) for iri in self._members[name])

    def _objects_for(self, parameter: Typed) -> list[Typed]:
        return [each for each in self._objects if self._posed.problem.domain.is_a(each.type, parameter.type)]

    def _abstract_arguments(self, parameters: Sequence[Typed]) -> Iterator[tuple[str, ...]]:
        """Yield all tuples of arguments with at least one abstract object."""
        fitting = [self._objects_for(each) for each in parameters]
        if prod(map(len, fitting)) > MAX_TUPLES:
            raise TooManyValues
        for chosen in product(*fitting):
            names = tuple(each.name for each in chosen)
            if not self._members.keys().isdisjoint(names):
                yield names


def _holds_decidedly(holds: Callable[[str], bool], individual: str) -> bool:
    try:
        return holds(individual)
    except EvaluationError:
        return False


def _duration_s(function: CostFunction, state: WorldState, bindings: Mapping[str, str]) -> Fraction:
    seconds = evaluate_duration_s(function.expression, state, bindings)
    return seconds if isinstance(seconds, Fraction) else ASSUMED_SECONDS
