"""Finds the nearest changes of a world after which a goal could be reached: what a person may change.

Backward from the goal, every way to make an atom true lacks something: facts that would have to hold, or to be gone.
What is lacking is tried: it counts if the goal can be reached, deletions ignored, once the world is changed like that.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias, assert_never

from msgspec.structs import replace

from skillc_model.conditions import Condition, Variable
from skillc_model.pddl.domain import Action, GuardMeaning, Meaning, RelationMeaning
from skillc_model.pddl.formulas import (
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
    atoms,
    conjuncts,
)
from skillc_model.pddl.problem import Problem
from skillc_model.rewriting import substitute
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.lacks import (
    NOTHING,
    AtomReader,
    Lack,
    NearestChange,
    Order,
    Way,
    combine_ways,
    find_stated,
    is_expected,
    keep_cheapest,
    sum_costs,
    to_order,
)
from skillc_runtime.planning.partial_bindings import PartialBindings, Values, unify
from skillc_runtime.planning.plan import Solved
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.planning.search.h_max import critical_path_s
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

_Literal: TypeAlias = tuple[Atom, bool]
MAX_DEPTH = 6
"""How many actions before the goal are considered."""

MAX_TRIED = 200
"""How many changes of the world are tried."""

MAX_SEARCHED = 8
SEARCH_S = 0.5
"""How many changes are tried by searching for a plan, and the time limit for each search."""


class NearestChanges:
    """Searches backward in a problem whose goal is out of reach; `grounding` is that of the problem, explored."""

    def __init__(self, problem: Problem, state: WorldState, grounding: Grounding, limit: CancelToken) -> None:
        self._problem, self._state, self._grounding, self._limit = problem, state, grounding, limit
        self._partial = PartialBindings(problem, grounding, limit)
        self._guards = _group_guards(problem)
        self._readers: dict[Lack, AtomReader] = {}
        self._stated: dict[Way, Way] = {}
        """Each change without what follows from it, as far as that was asked for."""
        self._wanted = frozenset(atoms(problem.goal))
        self._made: dict[_Literal, tuple[Way, ...]] = {}
        """What actions lack that make an atom true or false, as far as it was found where that was first needed."""

    def find(self) -> tuple[NearestChange, ...]:
        """Return the nearest changes with which the goal can be reached, all equally near; none if none is known."""
        ways = [each for each in self._ways(self._problem.goal, {}, None, 0, frozenset()) if each]
        single = {frozenset({lack}) for way in ways for lack in way}
        found: list[Way] = []
        for way in sorted({*single, *ways}, key=self._distance)[:MAX_TRIED]:
            if found and self._distance(way)[:2] != self._distance(found[0])[:2]:
                break
            if self._suffices(way):
                found.append(way)
        return tuple(map(self._with_readers, self._sort_by_time(found)))

    def find_blocking(self) -> tuple[NearestChange, ...]:
        """Return the facts, one each, that keep skills from starting, and without which the goal has a plan."""
        found = {
            self._lack(part.body, {}, False, AtomReader(0, action, part.body))
            for each in self._grounding.actions
            for action in (self._problem.domain.action[each.words[0]],)
            for part in conjuncts(each.precondition)
            if isinstance(part, Negation) and isinstance(part.body, Atom) and part.body in self._grounding.init
        }
        alone = [frozenset({each}) for each in sorted(found, key=to_order)[:MAX_SEARCHED]]
        return tuple(self._with_readers(way) for way in alone if self._has_plan(way))

    def _sort_by_time(self, ways: list[Way]) -> list[Way]:
        """Return equally near changes sorted by how soon the goal may hold then, if there is time to compare them."""
        searching = self._limit.limited(SEARCH_S)
        times = [critical_path_s(_apply(self._problem, each, self._guards), searching) for each in ways]
        order = sorted(range(len(ways)), key=times.__getitem__) if searching.remaining_s > 0.0 else range(len(ways))
        return [ways[each] for each in order]

    def _has_plan(self, way: Way) -> bool:
        changed = _apply(self._problem, way, self._guards)
        return isinstance(AStar().plan(changed, self._limit.limited(SEARCH_S)), Solved)

    def _suffices(self, way: Way) -> bool:
        """Whether the goal can be reached, deletions ignored, in a world changed in this way."""
        grounding = Grounding(_apply(self._problem, way, self._guards), self._limit)
        grounding.explore()
        return grounding.is_possible(grounding.goal())

    def _distance(self, way: Way) -> tuple[int, int, list[Order]]:
        """Return how far a change is: what it costs, then how near to the goal, where only consequences show."""
        left = self._without_consequences(way)
        return sum_costs(left), -max(self._readers[each].depth for each in left), sorted(map(to_order, way))

    def _with_readers(self, way: Way) -> NearestChange:
        ordered = sorted(self._without_consequences(way), key=lambda each: (self._is_guard(each), to_order(each)))
        return NearestChange(tuple((each, self._readers[each]) for each in ordered))

    def _without_consequences(self, way: Way) -> Way:
        """Return a change without conditions that hold once the facts are stated that are needed with them."""
        if way not in self._stated:
            guards = frozenset(filter(self._is_guard, way))
            facts = [each for lack in way - guards for each in self._state_fact(lack)]
            state = self._state.with_changes(facts) if guards and facts else None
            left = guards if state is None else {each for each in guards if not self._holds(each, state)}
            self._stated[way] = (way - guards) | left
        return self._stated[way]

    def _is_guard(self, lack: Lack) -> bool:
        return isinstance(self._meaning(lack), GuardMeaning)

    def _state_fact(self, lack: Lack) -> Iterator[AddRelation]:
        meaning = self._meaning(lack)
        if lack.holds and isinstance(meaning, RelationMeaning):
            subject, object_ = (self._problem.names[each] for each in lack.atom.terms)
            stated = find_stated(self._state, meaning.relation, subject, object_)
            if stated is not None:
                yield AddRelation(subject, stated, object_)

    def _holds(self, lack: Lack, state: WorldState) -> bool:
        meaning = self._meaning(lack)
        assert isinstance(meaning, GuardMeaning)
        names = zip(meaning.variables, lack.atom.terms, strict=True)
        try:
            holds = evaluate(meaning.condition, state, {each: self._problem.names[name] for each, name in names})
        except EvaluationError:
            return False
        return holds == lack.holds

    def _meaning(self, lack: Lack) -> Meaning:
        return self._problem.domain.predicate[lack.atom.predicate].meaning

    def _ways(
        self, formula: Formula, values: Values, by: Action | None, depth: int, visiting: frozenset[_Literal]
    ) -> tuple[Way, ...]:
        """Return what ways to make a formula true lack, those that lack the least first; none if it has no way."""
        self._limit.check()
        if self._grounding.can_hold(formula, values):
            return NOTHING
        match formula:
            case Atom():
                return self._ways_to_literal(formula, True, values, by, depth, visiting)
            case Negation(Atom() as atom):
                return self._ways_to_literal(atom, False, values, by, depth, visiting)
            case Negation() | Equal():
                return ()
            case Conjunction(parts):
                return combine_ways([self._ways(part, values, by, depth, visiting) for part in parts])
            case Disjunction(parts):
                return keep_cheapest(way for part in parts for way in self._ways(part, values, by, depth, visiting))
            case Existential(variable, body):
                scopes = self._scopes(variable, values)
                return keep_cheapest(way for scope in scopes for way in self._ways(body, scope, by, depth, visiting))
            case Universal(variable, body):
                scopes = self._scopes(variable, values)
                return combine_ways([self._ways(body, scope, by, depth, visiting) for scope in scopes])
            case _:
                assert_never(formula)

    def _scopes(self, variable: Typed, values: Values) -> list[dict[str, str]]:
        members = self._problem.domain.of_type(self._problem.objects, variable.type)
        return [{**values, variable.name: name} for name in members]

    def _ways_to_literal(
        self, read: Atom, holds: bool, values: Values, by: Action | None, depth: int, visiting: frozenset[_Literal]
    ) -> tuple[Way, ...]:
        atom = _bind(read, values)
        literal = atom, holds
        stated = (
            ()
            if by is None or (holds and atom in self._wanted)
            else (frozenset({self._lack(read, values, holds, AtomReader(depth, by, read))}),)
        )
        if literal in visiting or depth >= MAX_DEPTH or not self._problem.domain.predicate[atom.predicate].changes:
            return stated
        if literal not in self._made:
            self._made[literal] = keep_cheapest(self._ways_by_actions(literal, depth, visiting | {literal}))
        return keep_cheapest((*self._made[literal], *stated))

    def _ways_by_actions(self, literal: _Literal, depth: int, visiting: frozenset[_Literal]) -> Iterator[Way]:
        for action, start in self._makers(*literal):
            for bound, lacking in self._partial.find(action, start):
                yield from combine_ways([self._ways(each, bound, action, depth + 1, visiting) for each in lacking])

    def _makers(self, atom: Atom, holds: bool) -> Iterator[tuple[Action, dict[str, str]]]:
        """Yield the actions that make an atom true, or false, with the parameters that are bound by it."""
        for action in self._problem.domain.actions:
            for change in action.effects:
                start = unify(change.atom, atom, action) if change.positive == holds else None
                if start is not None and not any(self._partial.mistyped(action, start)):
                    yield action, start

    def _lack(self, read: Atom, values: Values, holds: bool, reader: AtomReader) -> Lack:
        atom = _bind(read, values)
        lack = Lack(atom, holds, self._cost_of(atom) if holds else 1)
        if lack not in self._readers or reader.depth < self._readers[lack].depth:
            self._readers[lack] = reader
        return lack

    def _cost_of(self, atom: Atom) -> int:
        """Return what it costs to state an atom.

        More if skills change it, if it contradicts another fact, or if others of their classes lack it, too.
        """
        predicate = self._problem.domain.predicate[atom.predicate]
        is_relation = isinstance(predicate.meaning, RelationMeaning)
        cost = 2 if predicate.changes and (is_relation or any(self._makers(atom, True))) else 1
        if isinstance(predicate.meaning, RelationMeaning):
            relation = self._state.vocabulary.relations[predicate.meaning.relation]
            subject, object_ = (self._problem.names.get(each, "") for each in atom.terms)
            cost += cost == 1 and not is_expected(self._state, relation.iri, subject, object_)
            cost += 2 * (relation.functional and bool(self._state.objects(subject, relation.iri)))
            cost += 2 * (relation.inverse_functional and bool(self._state.subjects(relation.iri, object_)))
        return cost


def _apply(problem: Problem, way: Way, guards: Mapping[str, Sequence[str]]) -> Problem:
    """Return a problem with an initial state changed in this way; `guards` are predicates of the same meaning."""
    same = [(each.holds, Atom(name, each.atom.terms)) for each in way for name in guards[each.atom.predicate]]
    gone = {atom for holds, atom in same if not holds}
    stated = (atom for holds, atom in same if holds)
    init = dict.fromkeys((*(each for each in problem.init if each not in gone), *stated))
    return replace(problem, init=tuple(init))


def _group_guards(problem: Problem) -> dict[str, list[str]]:
    """Return for each predicate those that mean the same: skills have predicates of their own for one condition."""
    groups: dict[Condition | str, list[str]] = {}
    for each in problem.domain.predicates:
        key: Condition | str = each.name
        if isinstance(each.meaning, GuardMeaning):
            numbered = {name: Variable(f"?{number}") for number, name in enumerate(each.meaning.variables)}
            key = substitute(each.meaning.condition, numbered)
        groups.setdefault(key, []).append(each.name)
    return {name: names for names in groups.values() for name in names}


def _bind(atom: Atom, values: Values) -> Atom:
    return Atom(atom.predicate, tuple(values.get(term, term) for term in atom.terms))
