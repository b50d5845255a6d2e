"""Whether one implementation fits its arguments in the world as it is, and what its parameters are then."""

from __future__ import annotations

import re
from collections.abc import Mapping, Set
from dataclasses import dataclass, field

from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import Implementation, Parameter, Post, Requirement
from skillc_runtime.selection.arguments import problem_with
from skillc_runtime.selection.describe import bindings_text
from skillc_runtime.selection.inferred import Inferred, infer_parameters
from skillc_runtime.trace.failure import Rejected, Stage
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Fitted:
    """The implementation can start: its bound parameters, and what a person may want to know about them.

    An optional parameter that was not passed and has no default is absent. `others` are the individuals that
    `infer any` passed over, by parameter.
    """

    implementation: Implementation
    bindings: dict[str, Value]
    others: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def fit(implementation: Implementation, arguments: Mapping[str, Value], state: WorldState) -> Fitted | Rejected:
    """Bind the parameters: arguments, defaults, inference; then check types, ranges and preconditions.

    EvaluationError when a default or a condition cannot be evaluated.
    """
    bindings: dict[str, Value] = {}
    rejected = bind_arguments(implementation, arguments, arguments.keys(), state, bindings)
    if rejected is not None:
        return rejected
    bind_defaults(implementation, state, bindings, arguments.keys())
    inferred = infer_parameters(implementation, bindings, state)
    if not isinstance(inferred, Inferred):
        return inferred
    bindings |= inferred.bindings
    bind_defaults(implementation, state, bindings, arguments.keys())
    rejected = _out_of_bounds(implementation, arguments, state, bindings)
    rejected = rejected or first_broken(implementation, implementation.pre, "pre", bindings, state)
    return rejected or Fitted(implementation, bindings, inferred.others, inferred.notes)


def first_broken(
    implementation: Implementation,
    requirements: tuple[Requirement, ...],
    stage: Stage,
    bindings: Mapping[str, Value],
    state: WorldState,
) -> Rejected | None:
    """Return the first requirement that does not hold, with what holds instead; None when all hold."""
    for requirement in requirements:
        if not evaluate(requirement.condition, state, bindings):
            reason = broken_text(implementation, requirement, stage, bindings, state)
            return Rejected(implementation=implementation.name, stage=stage, reason=reason, source=requirement.source)
    return None


def broken_text(
    implementation: Implementation,
    requirement: Requirement | Post,
    stage: str,
    bindings: Mapping[str, Value],
    state: WorldState,
) -> str:
    """Say that a condition does not hold, for which values, and what holds instead."""
    name = f"{requirement.label}: {requirement.text}" if requirement.label else requirement.text
    mentioned = [p for p in implementation.parameters if _mentions(requirement.text, p.name)]
    values = bindings_text(bindings, mentioned, state.vocabulary)
    where = " for " + ", ".join(f"{key} = {value}" for key, value in values.items()) if values else ""
    instead = explain(requirement.condition, state, bindings, state.vocabulary)
    return f"{stage} `{name}` does not hold{where}: {instead}"


def bind_arguments(
    implementation: Implementation,
    arguments: Mapping[str, Value],
    passed: Set[str],
    state: WorldState,
    bindings: dict[str, Value],
) -> Rejected | None:
    """Check the arguments and bind them; `passed` names also those whose values are not known yet."""
    known = {parameter.name for parameter in implementation.parameters if parameter.direction != "out"}
    unknown = [name for name in passed if name not in known]
    if unknown:
        return _rejected(implementation, f"{implementation.skill} has no parameter `{unknown[0]}`")
    for parameter in implementation.parameters:
        if parameter.name in arguments:
            value = arguments[parameter.name]
            problem = problem_with(parameter, value, state)
            if problem is not None:
                return _rejected(implementation, f"`{parameter.name}` {problem}", parameter)
            bindings[parameter.name] = value
        elif parameter.direction == "in" and parameter.name not in passed:
            return _rejected(implementation, f"`{parameter.name}` was not passed", parameter)
    return None


def bind_defaults(
    implementation: Implementation, state: WorldState, bindings: dict[str, Value], passed: Set[str]
) -> None:
    """Bind the defaults whose variables are all bound, and so in two goes those that need inferred parameters."""
    for parameter in implementation.parameters:
        default = parameter.default
        if default is None or parameter.name in bindings or parameter.name in passed:
            continue
        if bindings.keys() >= free_variables(default):
            bindings[parameter.name] = value_of(default, state, bindings)


def _out_of_bounds(
    implementation: Implementation, arguments: Mapping[str, Value], state: WorldState, bindings: Mapping[str, Value]
) -> Rejected | None:
    """Check what was not passed: a computed default may be out of range."""
    for parameter in implementation.parameters:
        if parameter.name in bindings and parameter.name not in arguments:
            problem = problem_with(parameter, bindings[parameter.name], state)
            if problem is not None:
                return _rejected(implementation, f"`{parameter.name}` {problem}", parameter)
    return None


def _rejected(implementation: Implementation, reason: str, parameter: Parameter | None = None) -> Rejected:
    source = parameter.source if parameter is not None else implementation.source
    return Rejected(implementation=implementation.name, stage="argument", reason=reason, source=source)


def _mentions(text: str, name: str) -> bool:
    return re.search(rf"\b{re.escape(name)}\b", text) is not None
