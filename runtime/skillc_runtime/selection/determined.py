"""Why the parameters of a fitting implementation are what they are: who decided, and which facts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set

from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import Implementation, Parameter, Requirement
from skillc_runtime.selection.fit import Fitted
from skillc_runtime.trace.reasons import Deciding, Determined
from skillc_runtime.world.eval.support import deciding_facts
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def determined(fitted: Fitted, passed: Set[str], state: WorldState) -> tuple[Determined, ...]:
    """Return the reason for each parameter that was not simply passed, in the order of the parameters.

    Parameters to infer are included when somebody passed them: they obey the same conditions.
    """
    return tuple(_each(fitted, passed, state))


def _each(fitted: Fitted, passed: Set[str], state: WorldState) -> Iterator[Determined]:
    implementation, bindings, short = fitted.implementation, fitted.bindings, state.vocabulary.short
    for parameter in implementation.parameters:
        name, inferred = parameter.name, parameter.direction == "infer"
        if name not in bindings or (name in passed and not inferred):
            continue
        yield Determined(
            parameter=name,
            how="passed" if name in passed else "inferred" if inferred else "default",
            conditions=_conditions(implementation, parameter, bindings, state) if inferred else (),
            others=tuple(short(other) for other in fitted.others.get(name, ())),
        )


def _conditions(
    implementation: Implementation, parameter: Parameter, bindings: Mapping[str, Value], state: WorldState
) -> tuple[Deciding, ...]:
    """Return the preconditions that speak of a parameter."""
    about = [each for each in implementation.pre if parameter.name in free_variables(each.condition)]
    return tuple(_deciding(each, bindings, state) for each in about)


def _deciding(requirement: Requirement, bindings: Mapping[str, Value], state: WorldState) -> Deciding:
    facts = deciding_facts([requirement.condition], state, bindings)
    return Deciding(text=requirement.text, source=requirement.source, facts=facts)
