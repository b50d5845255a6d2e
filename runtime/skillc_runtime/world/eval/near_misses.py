"""Finds near misses: individuals that satisfy all requirements but one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from skillc_model.conditions import Condition, IsA, Variable
from skillc_model.skills import Requirement
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import THING
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import Bindings
from skillc_runtime.world.eval.join import solutions
from skillc_runtime.world.state.world_state import WorldState

MAX_TRIED = 2000
"""The maximum number of individuals tried for each requirement that is left out."""

MAX_NEAR_MISSES = 3
"""If more individuals than this fit without a requirement, that requirement is no helpful explanation."""


class NearMiss(msgspec.Struct, frozen=True):
    """Individuals by parameter name that violate one requirement, and what holds instead.

    `requirement` is None if the class of the parameter in `about` is violated. `about` are the parameters that the
    requirement mentions.
    """

    bindings: dict[str, str]
    requirement: Requirement | None
    about: tuple[str, ...]
    reason: str


def find_near_misses(
    variables: Mapping[str, str], requirements: Sequence[Requirement], bindings: Bindings, state: WorldState
) -> tuple[NearMiss, ...]:
    """Return, for each requirement and then each parameter's class, the solutions without it if they are few.

    EvaluationError as in `evaluate`.
    """
    return (
        *_without_one_requirement(variables, requirements, bindings, state),
        *_of_another_class(variables, requirements, bindings, state),
    )


def _without_one_requirement(
    variables: Mapping[str, str], requirements: Sequence[Requirement], bindings: Bindings, state: WorldState
) -> Iterator[NearMiss]:
    for place, dropped in enumerate(requirements):
        mentioned = free_variables(dropped.condition)
        about = tuple(name for name in variables if name in mentioned)
        kept = [each.condition for each in (*requirements[:place], *requirements[place + 1 :])]
        for found in _few_solutions(about, variables, kept, bindings, state):
            reason = explain(dropped.condition, state, {**bindings, **found}, state.vocabulary)
            yield NearMiss(found, dropped, about, reason)


def _of_another_class(
    variables: Mapping[str, str], requirements: Sequence[Requirement], bindings: Bindings, state: WorldState
) -> Iterator[NearMiss]:
    """Yield solutions of another class, for parameters that a requirement restricts."""
    conditions = [each.condition for each in requirements]
    linked = frozenset[str]().union(*map(free_variables, conditions))
    for name, cls in variables.items():
        about = (name,) if name in linked else ()
        for found in _few_solutions(about, {**variables, name: THING}, conditions, bindings, state):
            reason = explain(IsA(Variable(name), cls), state, found, state.vocabulary)
            yield NearMiss(found, None, about, reason)


def _few_solutions(
    about: tuple[str, ...],
    variables: Mapping[str, str],
    conditions: Sequence[Condition],
    bindings: Bindings,
    state: WorldState,
) -> list[dict[str, str]]:
    """Return solutions that differ in the parameters `about`, in IRI order; none if there are many."""
    different: dict[tuple[str, ...], dict[str, str]] = {}
    for answer in solutions(variables, conditions, bindings, state, MAX_TRIED if about else 0):
        different.setdefault(tuple(answer[name] for name in about), answer)
        if len(different) > MAX_NEAR_MISSES:
            return []
    return [different[each] for each in sorted(different)]
