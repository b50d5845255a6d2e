"""Evaluates nested quantifiers together, as a join.

Variables are bound by the relation with the fewest candidates first; each part of the condition is tested as soon as
its variables are bound; variables that no part connects are searched apart; and what a search has found is remembered
by the values that it depends on. So the time grows with the variables that are needed at once, not with all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping

import msgspec

from skillc_model.blocks import Block
from skillc_model.conditions import Arithmetic, Condition, HasProperty, Holds, Individual, Invoke, PropertyOf, Variable
from skillc_model.traversal import free_variables, walk
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.cancellation import check_current
from skillc_runtime.world.eval.bindings import Bindings
from skillc_runtime.world.eval.links import Link, find_links
from skillc_runtime.world.eval.scope import ConditionTest, Scope
from skillc_runtime.world.state.world_state import WorldState


def compile_block(block: Block, compile_condition: Callable[[Condition], ConditionTest]) -> ConditionTest:
    """Return the test whether the block has a solution, for bindings that give all its free variables a value."""
    tests = tuple(map(compile_condition, block.parts))
    plans: list[tuple[Vocabulary, _JoinPlan]] = []

    def test(state: WorldState, bindings: Bindings) -> bool:
        if not plans or plans[0][0] is not state.vocabulary:
            plans[:] = [(state.vocabulary, _JoinPlan(block, tests, state.vocabulary))]
        return _Search(plans[0][1], state, Scope.inside(bindings)).succeeds()

    return test


class _Part(msgspec.Struct, frozen=True):
    """The test of a part, and the variables that have to be bound before."""

    test: ConditionTest
    needs: frozenset[str]


class _Component(msgspec.Struct, frozen=True):
    """Unbound variables that parts connect, and the bound ones on which these parts depend."""

    variables: frozenset[str]
    boundary: tuple[str, ...]


class _Step(msgspec.Struct, frozen=True):
    """The binding of one variable: the tests that it makes possible, and the components that remain."""

    tests: tuple[ConditionTest, ...]
    rest: tuple[_Component, ...]


class _JoinPlan:
    """What the search of a block needs to know that does not depend on facts."""

    def __init__(self, block: Block, tests: tuple[ConditionTest, ...], vocabulary: Vocabulary) -> None:
        self.classes = block.variables
        self._parts = tuple(_list_parts(block, tests, vocabulary))
        stored = [
            each for each in block.parts if not (isinstance(each, Holds) and vocabulary.is_computed(each.relation))
        ]
        self.links: Mapping[str, tuple[Link, ...]] = {name: tuple(find_links(stored, name)) for name in block.variables}
        self.first = _Step(
            tuple(each.test for each in self._parts if not each.needs), self._split(frozenset(block.variables))
        )
        self._steps: dict[tuple[frozenset[str], str], _Step] = {}

    def step(self, component: _Component, name: str) -> _Step:
        """Return the step that binds a variable of a component."""
        key = component.variables, name
        if key not in self._steps:
            rest = component.variables - {name}
            ready = (each for each in self._parts if name in each.needs and each.needs.isdisjoint(rest))
            self._steps[key] = _Step(tuple(each.test for each in ready), self._split(rest))
        return self._steps[key]

    def _split(self, left: frozenset[str]) -> tuple[_Component, ...]:
        """Return the components of unbound variables."""
        groups: list[frozenset[str]] = [frozenset({name}) for name in self.classes if name in left]
        for part in self._parts:
            touched = [group for group in groups if not group.isdisjoint(part.needs)]
            if len(touched) > 1:
                groups = [group for group in groups if group not in touched] + [frozenset().union(*touched)]
        return tuple(_Component(group, self._boundary(group)) for group in groups)

    def _boundary(self, group: frozenset[str]) -> tuple[str, ...]:
        needed = (part.needs for part in self._parts if not group.isdisjoint(part.needs))
        return tuple(sorted(frozenset().union(*needed) - group))


def _list_parts(block: Block, tests: tuple[ConditionTest, ...], vocabulary: Vocabulary) -> Iterator[_Part]:
    """Yield the parts; one that may fail waits for all before it, which may be what guards it."""
    before: frozenset[str] = frozenset()
    for condition, test in zip(block.parts, tests, strict=True):
        about = free_variables(condition) & block.variables.keys()
        before |= about
        yield _Part(test, before if _may_fail(condition, vocabulary) else about)


def _may_fail(condition: Condition, vocabulary: Vocabulary) -> bool:
    """Whether the evaluation may end with an error although all variables have values."""
    for each in walk(condition):
        match each:
            case Invoke() | Arithmetic():
                return True
            case Holds(relation=term) | HasProperty(property=term) if vocabulary.is_computed(term):
                return True
            case PropertyOf(of, term) if vocabulary.is_computed(term) or not isinstance(of, Variable | Individual):
                return True
    return False


class _Search:
    """The search for a solution in one version of the world."""

    def __init__(self, plan: _JoinPlan, state: WorldState, scope: Scope) -> None:
        self._plan, self._state, self._scope = plan, state, scope
        self._known: dict[Hashable, bool] = {}

    def succeeds(self) -> bool:
        """Whether there is a solution."""
        return self._is_done(self._plan.first)

    def _is_done(self, step: _Step) -> bool:
        """Whether the tests of a step hold and the components that remain have solutions."""
        return all(test(self._state, self._scope) for test in step.tests) and all(map(self._has_solution, step.rest))

    def _has_solution(self, component: _Component) -> bool:
        key = component.variables, *map(self._scope.__getitem__, component.boundary)
        found = self._known.get(key)
        if found is None:
            found = self._known[key] = self._bind(component)
        return found

    def _bind(self, component: _Component) -> bool:
        """Bind the variable with the fewest candidates to one after the other, until one leads to a solution."""
        check_current()
        state, scope = self._state, self._scope
        found = {name: self._candidates(name, component) for name in component.variables}
        name = min(component.variables, key=lambda each: (len(found[each]), each))
        step, cls = self._plan.step(component, name), self._plan.classes[name]
        for individual in found[name]:
            if state.is_a(individual, cls):
                scope[name] = individual
                if self._is_done(step):
                    return True
        return False

    def _candidates(self, name: str, component: _Component) -> frozenset[str]:
        """Return the smallest set of candidates that the indexes offer."""
        best = self._state.instances(self._plan.classes[name])
        for link in self._plan.links[name]:
            if not (isinstance(link.other, Variable) and link.other.name in component.variables):
                found = link.candidates(self._state, self._scope)
                if found is not None and len(found) < len(best):
                    best = found
        return best
