"""Infers parameters of a skill from the world and the skill's preconditions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import msgspec

from skillc_model.conditions import Condition, Exists
from skillc_model.skills import Parameter, Requirement
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import Bindings
from skillc_runtime.world.eval.join import solutions
from skillc_runtime.world.eval.near_misses import NearMiss, find_near_misses
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

Binding: TypeAlias = dict[str, str]
"""Individuals by parameter name."""


class Inferred(msgspec.Struct, frozen=True):
    """The inferred parameters; `others` are further solutions for `infer any`, in IRI order."""

    bindings: Binding
    others: tuple[Binding, ...] = ()


class NoneFound(msgspec.Struct, frozen=True):
    """No solution: the requirement that excludes the last one (None if a class has no individual), and the reason.

    `nearest` are individuals that violate a single requirement.
    """

    requirement: Requirement | None
    reason: str
    nearest: tuple[NearMiss, ...] = ()


class Ambiguous(msgspec.Struct, frozen=True):
    """Several solutions where one is needed, in IRI order."""

    candidates: tuple[Binding, ...]


Inference: TypeAlias = Inferred | NoneFound | Ambiguous


def infer(
    parameters: Sequence[Parameter], requirements: Sequence[Requirement], bindings: Bindings, state: WorldState
) -> Inference:
    """Find the individuals of the parameters that satisfy the requirements about them.

    The solution must be unique; parameters declared `infer any` take the first in IRI order. Requirements about none of
    the parameters are ignored. EvaluationError when a requirement cannot be evaluated.
    """
    if not parameters:
        return Inferred({})
    variables = {parameter.name: _class_of(parameter) for parameter in parameters}
    conditions = [requirement.condition for requirement in requirements]
    answers = sorted(
        ({name: answer[name] for name in variables} for answer in solutions(variables, conditions, bindings, state)),
        key=lambda answer: tuple(answer.values()),
    )
    if not answers:
        return _why_none(variables, requirements, bindings, state)
    fixed = [parameter.name for parameter in parameters if not parameter.any_]
    if len({tuple(answer[name] for name in fixed) for answer in answers}) > 1:
        return Ambiguous(tuple(answers))
    return Inferred(answers[0], tuple(answers[1:]))


def _class_of(parameter: Parameter) -> str:
    if not isinstance(parameter.type, ClassType):
        raise EvaluationError(f"`{parameter.name}` cannot be inferred: only individuals can")
    return parameter.type.iri


def _why_none(
    variables: dict[str, str], requirements: Sequence[Requirement], bindings: Bindings, state: WorldState
) -> NoneFound:
    """Add requirements one by one until no solution is left, and explain the last one for the solution before it."""
    for name, cls in variables.items():
        if not state.instances(cls):
            reason = f"`{name}`: there is no {state.vocabulary.short(cls)} in the world model"
            return NoneFound(None, reason, find_near_misses(variables, requirements, bindings, state))
    before, linked = _first(variables, (), bindings, state) or {}, frozenset[str]()
    for count, requirement in enumerate(requirements, start=1):
        left = _first(variables, [each.condition for each in requirements[:count]], bindings, state)
        if left is None:
            reason = _explained(requirement.condition, linked, variables, {**bindings, **before}, state)
            return NoneFound(requirement, reason, find_near_misses(variables, requirements, bindings, state))
        before = left
        linked |= free_variables(requirement.condition)
    raise AssertionError("there is a solution")


def _explained(
    condition: Condition, linked: frozenset[str], variables: dict[str, str], scope: Bindings, state: WorldState
) -> str:
    """Explain a condition; variables that no earlier requirement restricts are quantified."""
    for name in sorted((free_variables(condition) & variables.keys()) - linked):
        condition = Exists(name, variables[name], condition)
    return explain(condition, state, scope, state.vocabulary)


def _first(
    variables: dict[str, str], conditions: Sequence[Condition], bindings: Bindings, state: WorldState
) -> Binding | None:
    return next(solutions(variables, conditions, bindings, state), None)
