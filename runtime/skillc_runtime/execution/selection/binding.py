"""Binds the parameters of one implementation in the current world, or rejects it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Set

import msgspec

from skillc_model.skills import Implementation, Parameter, Post, Requirement
from skillc_model.traversal import free_variables
from skillc_runtime.execution.selection.arguments import check_value
from skillc_runtime.execution.selection.inferred_parameters import InferredParameters, infer_parameters
from skillc_runtime.recording.failure import Rejection, Stage
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.labels.labelled_text import format_value
from skillc_runtime.world.state.labels.labelling import label_bindings
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class BoundImplementation(msgspec.Struct, frozen=True):
    """An implementation that can start, with its bound parameters and notes about them for users.

    An optional parameter that was not passed and has no default is absent. `alternatives` are the individuals that
    `infer any` did not choose, by parameter, and `others` its other choices.
    """

    implementation: Implementation
    bindings: dict[str, Value]
    alternatives: Mapping[str, tuple[str, ...]] = msgspec.field(default_factory=dict)
    notes: tuple[str, ...] = ()
    others: tuple[Mapping[str, Value], ...] = ()


def bind_implementation(
    implementation: Implementation, arguments: Mapping[str, Value], state: WorldState
) -> BoundImplementation | Rejection:
    """Bind the parameters: arguments, defaults, inference; then check types, ranges and preconditions.

    EvaluationError if a default or a condition cannot be evaluated.
    """
    bindings: dict[str, Value] = {}
    rejected = bind_arguments(implementation, arguments, arguments.keys(), state, bindings)
    if rejected is not None:
        return rejected
    bind_defaults(implementation, state, bindings, arguments.keys())
    inferred = infer_parameters(implementation, bindings, state)
    if not isinstance(inferred, InferredParameters):
        return inferred
    bindings |= inferred.bindings
    bind_defaults(implementation, state, bindings, arguments.keys())
    rejected = _check_defaults(implementation, arguments, state, bindings)
    rejected = rejected or check_requirements(implementation, implementation.pre, "pre", bindings, state)
    return rejected or BoundImplementation(
        implementation, bindings, inferred.alternatives, inferred.notes, inferred.others
    )


def check_requirements(
    implementation: Implementation,
    requirements: tuple[Requirement, ...],
    stage: Stage,
    bindings: Mapping[str, Value],
    state: WorldState,
) -> Rejection | None:
    """Reject an implementation for the first requirement that does not hold; None if all hold."""
    for requirement in requirements:
        if not evaluate(requirement.condition, state, bindings):
            reason = describe_unmet_condition(implementation, requirement, stage, bindings, state)
            return Rejection(implementation=implementation.name, stage=stage, reason=reason, source=requirement.source)
    return None


def describe_unmet_condition(
    implementation: Implementation,
    requirement: Requirement | Post,
    stage: str,
    bindings: Mapping[str, Value],
    state: WorldState,
) -> str:
    """Describe a condition that does not hold, the values of its variables, and what holds instead."""
    name = f"{requirement.label}: {requirement.text}" if requirement.label else requirement.text
    mentioned = [p for p in implementation.parameters if _mentions(requirement.text, p.name)]
    values = label_bindings(bindings, mentioned, state.vocabulary)
    where = " for " + ", ".join(f"{key} = {format_value(value)}" for key, value in values.items()) if values else ""
    instead = explain(requirement.condition, state, bindings, state.vocabulary)
    return f"{stage} `{name}` does not hold{where}: {instead}"


def bind_arguments(
    implementation: Implementation,
    arguments: Mapping[str, Value],
    passed: Set[str],
    state: WorldState,
    bindings: dict[str, Value],
) -> Rejection | None:
    """Check the arguments and bind them; `passed` includes those whose values are not known yet."""
    known = {parameter.name for parameter in implementation.parameters if parameter.direction != "out"}
    unknown = [name for name in passed if name not in known]
    if unknown:
        return _reject(implementation, f"{implementation.skill} has no parameter `{unknown[0]}`")
    for parameter in implementation.parameters:
        if parameter.name in arguments:
            value = arguments[parameter.name]
            problem = check_value(parameter, value, state)
            if problem is not None:
                return _reject(implementation, f"`{parameter.name}` {problem}", parameter)
            bindings[parameter.name] = value
        elif parameter.direction == "in" and parameter.name not in passed:
            return _reject(implementation, f"`{parameter.name}` was not passed", parameter)
    return None


def bind_defaults(
    implementation: Implementation, state: WorldState, bindings: dict[str, Value], passed: Set[str]
) -> None:
    """Bind the defaults whose variables are all bound; called again for those that need inferred parameters."""
    for parameter in implementation.parameters:
        default = parameter.default
        if default is None or parameter.name in bindings or parameter.name in passed:
            continue
        if bindings.keys() >= free_variables(default):
            bindings[parameter.name] = value_of(default, state, bindings)


def _check_defaults(
    implementation: Implementation, arguments: Mapping[str, Value], state: WorldState, bindings: Mapping[str, Value]
) -> Rejection | None:
    """Check what was not passed: a computed default may be out of range."""
    for parameter in implementation.parameters:
        if parameter.name in bindings and parameter.name not in arguments:
            problem = check_value(parameter, bindings[parameter.name], state)
            if problem is not None:
                return _reject(implementation, f"`{parameter.name}` {problem}", parameter)
    return None


def _reject(implementation: Implementation, reason: str, parameter: Parameter | None = None) -> Rejection:
    source = parameter.source if parameter is not None else implementation.source
    return Rejection(implementation=implementation.name, stage="argument", reason=reason, source=source)


def _mentions(text: str, name: str) -> bool:
    return re.search(rf"\b{re.escape(name)}\b", text) is not None
