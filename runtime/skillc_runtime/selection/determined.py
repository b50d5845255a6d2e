"""Why the parameters of a fitting implementation are what they are: who decided, and which facts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set

from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import Implementation, Parameter, Requirement
from skillc_runtime.recording.reasons import DecidingCondition, ParameterReason
from skillc_runtime.selection.fit import Fitted
from skillc_runtime.world.labelled import label
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.support import facts_of
from skillc_runtime.world.values import Value


def determined(fitted: Fitted, passed: Set[str], state: WorldState) -> tuple[ParameterReason, ...]:
    """Return the reason for each parameter that was not simply passed, in the order of the parameters.

    Parameters to infer are included when somebody passed them: they obey the same conditions.
    """
    return tuple(_each(fitted, passed, state))


def _each(fitted: Fitted, passed: Set[str], state: WorldState) -> Iterator[ParameterReason]:
    implementation, bindings, words = fitted.implementation, fitted.bindings, state.vocabulary
    for parameter in implementation.parameters:
        name, inferred = parameter.name, parameter.direction == "infer"
        if name not in bindings or (name in passed and not inferred):
            continue
        yield ParameterReason(
            parameter=name,
            how="passed" if name in passed else "inferred" if inferred else "default",
            conditions=_conditions(implementation, parameter, bindings, state) if inferred else (),
            others=tuple(label(other, words) for other in fitted.others.get(name, ())),
        )


def _conditions(
    implementation: Implementation, parameter: Parameter, bindings: Mapping[str, Value], state: WorldState
) -> tuple[DecidingCondition, ...]:
    """Return the preconditions that speak of a parameter."""
    about = [each for each in implementation.pre if parameter.name in free_variables(each.condition)]
    return tuple(_deciding(each, bindings, state) for each in about)


def _deciding(requirement: Requirement, bindings: Mapping[str, Value], state: WorldState) -> DecidingCondition:
    facts = facts_of([requirement.condition], state, bindings)
    return DecidingCondition(text=requirement.text, source=requirement.source, facts=facts)
