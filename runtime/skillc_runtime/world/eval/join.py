"""Finds all bindings of variables to individuals under which conditions hold, by a join over the indexes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import repeat

import msgspec

from skillc_model.conditions import Condition, Holds, Term, Variable
from skillc_model.traversal import conjuncts, free_variables
from skillc_runtime.world.eval.bindings import Bindings, iri_of
from skillc_runtime.world.eval.conditions import compile_condition
from skillc_runtime.world.eval.scope import ConditionTest
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def solutions(
    variables: Mapping[str, str],
    conditions: Iterable[Condition],
    bindings: Bindings,
    state: WorldState,
    most_tried: int | None = None,
) -> Iterator[dict[str, str]]:
    """Yield each binding of the variables (name to class) under which all conditions about them hold.

    The order is deterministic. Conditions about none of the variables are ignored. The search ends after `most_tried`
    individuals. EvaluationError as in `evaluate`.
    """
    relevant = (condition for condition in conditions if not free_variables(condition).isdisjoint(variables))
    filters = [_filter(part, variables) for condition in relevant for part in conjuncts(condition)]
    scope = {**bindings, **dict.fromkeys(variables)}
    if not all(each.test(state, scope) for each in filters if not each.about):
        return
    tries = repeat(True) if most_tried is None else repeat(True, most_tried)
    yield from _bind_next(dict(variables), tuple(filters), scope, state, tries)


class _Filter(msgspec.Struct, frozen=True):
    """A condition with the searched variables that it mentions."""

    condition: Condition
    about: frozenset[str]
    test: ConditionTest


def _filter(condition: Condition, variables: Mapping[str, str]) -> _Filter:
    return _Filter(condition, free_variables(condition) & variables.keys(), compile_condition(condition))


def _bind_next(
    left: dict[str, str],
    filters: tuple[_Filter, ...],
    scope: dict[str, Value | None],
    state: WorldState,
    tries: Iterator[bool],
) -> Iterator[dict[str, str]]:
    """Bind the variable with the fewest candidates, then the others, testing each condition as soon as it is bound."""
    if not left:
        yield {}
        return
    found = {name: _candidates(name, left, filters, scope, state) for name in left}
    name = min(left, key=lambda each: len(found[each]))
    rest = {other: cls for other, cls in left.items() if other != name}
    ready = tuple(each.test for each in filters if name in each.about and each.about.isdisjoint(rest))
    cls = left[name]
    for individual in sorted(found[name]):
        if not next(tries, False):
            break
        if state.is_a(individual, cls):
            scope[name] = individual
            if all(test(state, scope) for test in ready):
                for others in _bind_next(rest, filters, scope, state, tries):
                    yield {name: individual, **others}
    scope[name] = None


def _candidates(
    name: str, left: dict[str, str], filters: tuple[_Filter, ...], scope: dict[str, Value | None], state: WorldState
) -> frozenset[str]:
    """Return the smallest set of candidates for a variable that the indexes offer."""
    best = state.instances(left[name])
    for each in filters:
        condition = each.condition
        if isinstance(condition, Holds) and name in each.about and condition.relation not in state.axioms.computed:
            related = _related(name, condition, scope, state)
            if related is not None and len(related) < len(best):
                best = related
    return best


def _related(name: str, holds: Holds, scope: dict[str, Value | None], state: WorldState) -> frozenset[str] | None:
    subject, object_ = iri_of(holds.subject, scope), iri_of(holds.object, scope)
    if subject is None and object_ is not None and _is(holds.subject, name):
        return state.subjects(holds.relation, object_)
    if object_ is None and subject is not None and _is(holds.object, name):
        return state.objects(subject, holds.relation)
    return None


def _is(term: Term, name: str) -> bool:
    return isinstance(term, Variable) and term.name == name
