"""A lower bound on every plan of a scene, from a problem as small as that for a part of it.

All individuals of a type that were left out are taken for one thing, their *stand-in*. Map every plan of the scene to
the stand-ins, step by step: atoms about kept things stay exactly what they are, atoms about stand-ins are never deleted
and so hold whenever they hold of anybody they stand for. What denies something of a stand-in is taken for true, and a
duration that depends on one is the least of those it stands for. So the mapped steps are a plan, and no longer: no
plan of the scene is shorter than the shortest one here, and there is none if there is none here.

What an axiom forbids is used to come closer: an assertion of a functional relation deletes all other values.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from math import prod
from typing import assert_never

from skillc_model.pddl.costs import ASSUMED_SECONDS
from skillc_model.pddl.domain import (
    ClassFact,
    CostFunction,
    GoalFact,
    GuardFact,
    PlanningDomain,
    Predicate,
    PropertyFact,
    RelationFact,
)
from skillc_model.pddl.formulas import Atom, Typed
from skillc_model.pddl.names import fresh
from skillc_model.pddl.problem import CostValue, Problem
from skillc_runtime.planning.abstraction.relaxation import DomainRelaxation, NotRelaxable
from skillc_runtime.planning.problem.initial_state import TooManyValues, evaluate_duration_s
from skillc_runtime.planning.problem.pose import Posed
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import has_value
from skillc_runtime.world.state.world_state import WorldState

MOST_TUPLES = 100_000


def relax_scene(posed: Posed, state: WorldState) -> Problem | None:
    """Return the problem whose shortest plan is no longer than any plan of the whole scene.

    A stand-in is named after the first of those it stands for. None where the problem is not narrowed, where the goal
    is open, where an effect depends on conditions in a way that cannot be weakened, or where there would be too much to
    say about stand-ins.
    """
    if not posed.narrowed or posed.open_goal:
        return None
    problem = posed.problem
    weakening = DomainRelaxation(problem.domain, problem.goal, posed.library.vocabulary)
    try:
        return _StandIns(posed, state).problem(weakening.domain(), weakening)
    except (NotRelaxable, TooManyValues):
        return None


class _StandIns:
    def __init__(self, posed: Posed, state: WorldState) -> None:
        self._posed, self._state = posed, state
        taken = {*posed.problem.names, *posed.problem.domain.names}
        self._typed = tuple(Typed(fresh(f"other-{type_}", taken), type_) for type_ in sorted(posed.others))
        self._members = {each.name: posed.others[each.type] for each in self._typed}
        self._objects = tuple(sorted((*posed.problem.objects, *self._typed), key=lambda each: each.name))
        self._kept = {iri: name for name, iri in posed.problem.names.items()}
        self._others: dict[str, str] = {}
        for name, iris in self._members.items():
            self._others.update(dict.fromkeys(iris, name))

    def problem(self, domain: PlanningDomain, weakening: DomainRelaxation) -> Problem:
        """Return the problem of a weakened domain."""
        problem = self._posed.problem
        facts = {atom for predicate in problem.domain.predicates for atom in self._facts(predicate)}
        may = {
            Atom(weakening.may[atom.predicate], atom.terms)
            for atom in (*problem.init, *facts)
            if atom.predicate in weakening.may
        }
        exactly = {atom for atom in problem.init if atom.predicate in weakening.denied}
        marks = {Atom(weakening.mark, (each.name,)) for each in self._typed}
        return Problem(
            name="bound",
            domain=domain,
            objects=self._objects,
            names={**problem.names, **{name: min(members) for name, members in self._members.items()}},
            init=tuple(sorted(may | exactly | marks, key=lambda each: (each.predicate, each.terms))),
            costs=(*problem.costs, *(value for each in domain.costs for value in self._costs(each))),
            goal=weakening.formula(problem.goal),
        )

    def _facts(self, predicate: Predicate) -> Iterator[Atom]:
        """Yield what a predicate says of stand-ins."""
        match predicate.meaning:
            case RelationFact(relation=relation):
                yield from (Atom(predicate.name, pair) for pair in self._linked(relation))
            case PropertyFact(property=property_, value=value):
                yield from (Atom(predicate.name, (name,)) for name in self._valued(property_, value))
            case ClassFact(cls=cls):
                found = self._state.instances(cls)
                holding = (name for name, members in self._members.items() if not found.isdisjoint(members))
                yield from (Atom(predicate.name, (name,)) for name in holding)
            case GuardFact(variables=(variable,), condition=condition):
                fits = (each.name for each in self._fitting(predicate.parameters[0]) if each.name in self._members)
                accepted = self._of_some(fits, lambda iri: evaluate(condition, self._state, {variable: iri}))
                yield from (Atom(predicate.name, (name,)) for name in accepted)
            case GuardFact():
                yield from (Atom(predicate.name, names) for names in self._choices(predicate.parameters))
            case GoalFact():
                return
            case _:
                assert_never(predicate.meaning)

    def _linked(self, relation: str) -> set[tuple[str, str]]:
        """Return the pairs of objects, one of them a stand-in at least, of which a relation may hold."""
        kept, others = self._kept, self._others
        found = set()
        for subject, object_ in self._state.pairs(relation):
            if subject in others or object_ in others:
                found.add((others.get(subject) or kept.get(subject), others.get(object_) or kept.get(object_)))
        return {(subject, object_) for subject, object_ in found if subject is not None and object_ is not None}

    def _valued(self, property_: str, value: bool | str) -> Iterable[str]:
        """Return the stand-ins for somebody of whom a property may have a value."""
        if self._state.vocabulary.properties[property_].computed_by is None:
            return {self._others[iri] for iri in self._state.individuals_with(property_, value) if iri in self._others}
        return self._of_some(self._members, lambda iri: has_value(property_of(self._state, iri, property_), value))

    def _of_some(self, names: Iterable[str], holds: Callable[[str], bool]) -> Iterator[str]:
        """Yield those stand-ins of which something holds for one at least that they stand for."""
        return (name for name in names if any(_decided(holds, iri) for iri in self._members[name]))

    def _costs(self, function: CostFunction) -> Iterator[CostValue]:
        for names in self._choices(function.parameters):
            least = self._least(function, names[0]) if len(names) == 1 else Fraction(0)
            yield CostValue(function.name, names, least)

    def _least(self, function: CostFunction, name: str) -> Fraction:
        (variable,) = function.variables
        return min(_seconds(function, self._state, {variable: iri}) for iri in self._members[name])

    def _fitting(self, parameter: Typed) -> list[Typed]:
        return [each for each in self._objects if self._posed.problem.domain.is_a(each.type, parameter.type)]

    def _choices(self, parameters: Sequence[Typed]) -> Iterator[tuple[str, ...]]:
        """Yield all tuples for the parameters that have a stand-in among them."""
        fitting = [self._fitting(each) for each in parameters]
        if prod(map(len, fitting)) > MOST_TUPLES:
            raise TooManyValues
        for chosen in product(*fitting):
            names = tuple(each.name for each in chosen)
            if not self._members.keys().isdisjoint(names):
                yield names


def _decided(holds: Callable[[str], bool], individual: str) -> bool:
    try:
        return holds(individual)
    except EvaluationError:
        return False


def _seconds(function: CostFunction, state: WorldState, bindings: Mapping[str, str]) -> Fraction:
    seconds = evaluate_duration_s(function.expression, state, bindings)
    return seconds if isinstance(seconds, Fraction) else ASSUMED_SECONDS
