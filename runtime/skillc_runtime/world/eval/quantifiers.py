"""Evaluates quantified conditions: a single quantifier by its candidates, nested ones by a join (see `blocks`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from skillc_model.blocks import make_block
from skillc_model.conditions import Condition, Exists, Forall
from skillc_model.traversal import free_variables
from skillc_runtime.cancellation import check_current
from skillc_runtime.world.eval.bindings import Bindings
from skillc_runtime.world.eval.blocks import compile_block
from skillc_runtime.world.eval.links import find_links
from skillc_runtime.world.eval.scope import ConditionTest, Scope, contains_quantifier, remember
from skillc_runtime.world.state.world_state import WorldState

Candidates: TypeAlias = Callable[[WorldState, Bindings], frozenset[str]]
Compile: TypeAlias = Callable[[Condition], ConditionTest]


def compile_quantified(condition: Exists | Forall, compile_condition: Compile) -> ConditionTest:
    """Return the test for a quantified condition; `compile_condition` makes the tests of its parts."""
    block = make_block(condition)
    if len(block.variables) == 1:
        return remember(condition, _compile_single(condition, compile_condition))
    wanted = isinstance(condition, Exists)
    has_solution = compile_block(block, compile_condition)
    outer = tuple(free_variables(condition))
    single: list[ConditionTest] = []

    def test(state: WorldState, bindings: Bindings) -> bool:
        if all(bindings.get(name) is not None for name in outer):
            return has_solution(state, bindings) == wanted
        # Parts of the condition guard others against parameters that were not passed: keep the order of the text.
        if not single:
            single.append(_compile_single(condition, compile_condition))
        return single[0](state, bindings)

    return remember(condition, test)


def _compile_single(condition: Exists | Forall, compile_condition: Compile) -> ConditionTest:
    """Return the test that tries the candidates of the outermost quantifier."""
    body, variable, cls = compile_condition(condition.body), condition.variable, condition.cls
    wanted = isinstance(condition, Exists)
    narrow = candidates(condition)
    nested = contains_quantifier(condition.body)

    def test(state: WorldState, bindings: Bindings) -> bool:
        scope = Scope.inside(bindings) if nested else dict(bindings)
        for individual in narrow(state, bindings):
            if nested:
                check_current()
            if state.is_a(individual, cls):
                scope[variable] = individual
                if body(state, scope) == wanted:
                    return wanted
        return not wanted

    return test


def candidates(condition: Exists | Forall) -> Candidates:
    """Return a function that returns candidates, among them all individuals that decide the condition.

    For `exists x: C (.. x r a ..)` those that have the relation; for `forall` those that could violate the body. Of
    several relations, the one with the fewest individuals counts.
    """
    cls, links = condition.cls, tuple(find_links(make_block(condition).parts, condition.variable))

    def find(state: WorldState, bindings: Bindings) -> frozenset[str]:
        best: frozenset[str] | None = None
        for link in links:
            if best is None or link.relation not in state.axioms.computed:
                found = link.candidates(state, bindings)
                if found is not None and (best is None or len(found) < len(best)):
                    best = found
        return state.instances(cls) if best is None else best

    return find
