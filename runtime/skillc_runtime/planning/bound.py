"""A lower bound on every plan of a scene, from a problem as small as that for a part of it.

All individuals of a type that were left out are taken for one thing, their *stand-in*. Map every plan of the scene to
the stand-ins, step by step: atoms about kept things stay exactly what they are, atoms about stand-ins are never deleted
and so hold whenever they hold of anybody they stand for. What denies something of a stand-in is taken for true, and a
duration that depends on one is the least of those it stands for. So the mapped steps are a plan, and no longer: no
plan of the scene is shorter than the shortest one here, and there is none if there is none here.

What an axiom forbids is used to come closer: an assertion of a functional relation deletes all other values.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import product
from math import prod
from typing import assert_never

from skillc_compiler.library.pddl.costs import ASSUMED_SECONDS, units
from skillc_compiler.library.pddl.domain import (
    ClassFact,
    CostFunction,
    GoalFact,
    GuardFact,
    PlanningDomain,
    Predicate,
    PropertyFact,
    RelationFact,
)
from skillc_compiler.library.pddl.formulas import Atom, Typed
from skillc_compiler.library.pddl.names import fresh
from skillc_compiler.library.pddl.problem import CostValue, Problem
from skillc_compiler.library.pddl.relations import Relations
from skillc_runtime.planning.initial import TooManyValues
from skillc_runtime.planning.problem import Posed
from skillc_runtime.planning.weakening import Refused, Weakening
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.expressions import EvaluationError, property_of, value_of
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import has

MOST_TUPLES = 100_000


def relaxed_scene(posed: Posed, state: WorldState) -> Problem | None:
    """Return the problem whose shortest plan is no longer than any plan of the whole scene.

    A stand-in is named after the first of those it stands for. None where the problem is not narrowed, where an effect
    depends on conditions in a way that cannot be weakened, or where there would be too much to say about stand-ins.
    """
    if not posed.narrowed:
        return None
    problem = posed.problem
    weakening = Weakening(problem.domain, problem.goal, Relations(posed.library.vocabulary))
    try:
        return _StandIns(posed, state).problem(weakening.domain(), weakening)
    except (Refused, TooManyValues):
        return None


class _StandIns:
    def __init__(self, posed: Posed, state: WorldState) -> None:
        self._posed, self._state = posed, state
        by_type: dict[str, list[str]] = defaultdict(list)
        for iri, type_ in sorted(posed.others.items()):
            by_type[type_].append(iri)
        taken = {*posed.problem.names, *posed.problem.domain.names}
        self._typed = tuple(Typed(fresh(f"other-{type_}", taken), type_) for type_ in sorted(by_type))
        self._members = {each.name: by_type[each.type] for each in self._typed}
        self._objects = tuple(sorted((*posed.problem.objects, *self._typed), key=lambda each: each.name))
        kept = {iri: name for name, iri in posed.problem.names.items()}
        self._names = kept | {iri: name for name, iris in self._members.items() for iri in iris}

    def problem(self, domain: PlanningDomain, weakening: Weakening) -> Problem:
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
            names={**problem.names, **{name: members[0] for name, members in self._members.items()}},
            init=tuple(sorted(may | exactly | marks, key=lambda each: (each.predicate, each.terms))),
            costs=(*problem.costs, *(value for each in domain.costs for value in self._costs(each))),
            goal=weakening.formula(problem.goal),
        )

    def _facts(self, predicate: Predicate) -> Iterator[Atom]:
        """Yield what a predicate says of stand-ins."""
        match predicate.meaning:
            case RelationFact(relation=relation):
                names, others = self._names, self._posed.others
                for subject, object_ in self._state.pairs(relation):
                    if (subject in others or object_ in others) and subject in names and object_ in names:
                        yield Atom(predicate.name, (names[subject], names[object_]))
            case PropertyFact(property=property_, value=value):
                state = self._state
                yield from self._of_some(predicate.name, lambda iri: has(property_of(state, iri, property_), value))
            case ClassFact(cls=cls):
                yield from self._of_some(predicate.name, lambda iri: self._state.is_a(iri, cls))
            case GuardFact(variables=(variable,), condition=condition):
                fits = {each.name for each in self._fitting(predicate.parameters[0])}
                found = self._of_some(predicate.name, lambda iri: evaluate(condition, self._state, {variable: iri}))
                yield from (atom for atom in found if atom.terms[0] in fits)
            case GuardFact():
                yield from (Atom(predicate.name, names) for names in self._choices(predicate.parameters))
            case GoalFact():
                return
            case _:
                assert_never(predicate.meaning)

    def _of_some(self, predicate: str, holds: Callable[[str], bool]) -> Iterator[Atom]:
        for name, members in self._members.items():
            if any(_decided(holds, iri) for iri in members):
                yield Atom(predicate, (name,))

    def _costs(self, function: CostFunction) -> Iterator[CostValue]:
        for names in self._choices(function.parameters):
            least = self._least(function, names[0]) if len(names) == 1 else 1
            yield CostValue(function.name, names, least)

    def _least(self, function: CostFunction, name: str) -> int:
        (variable,) = function.variables
        return min(_units(function, self._state, {variable: iri}) for iri in self._members[name])

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


def _units(function: CostFunction, state: WorldState, bindings: Mapping[str, str]) -> int:
    try:
        seconds = value_of(function.expression, state, dict(bindings))
    except EvaluationError:
        return units(ASSUMED_SECONDS)
    return units(seconds) if isinstance(seconds, int | float) else units(ASSUMED_SECONDS)
