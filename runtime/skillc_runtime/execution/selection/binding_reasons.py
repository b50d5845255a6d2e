"""Explains the values of the parameters of an implementation: where each comes from, and which facts decided."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set

from skillc_model.skills import Implementation, Parameter, Requirement
from skillc_model.traversal import free_variables
from skillc_runtime.execution.selection.binding import BoundImplementation
from skillc_runtime.recording.reasons import DecidingCondition, ParameterReason
from skillc_runtime.world.eval.deciding_facts import deciding_facts
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def explain_bindings(bound: BoundImplementation, passed: Set[str], state: WorldState) -> tuple[ParameterReason, ...]:
    """Return the reason for the value of each parameter that is not just an argument, in the order of the parameters.

    Parameters to infer are included even if they were passed, since the same conditions apply to them.
    """
    return tuple(_explain_each(bound, passed, state))


def _explain_each(bound: BoundImplementation, passed: Set[str], state: WorldState) -> Iterator[ParameterReason]:
    implementation, bindings, words = bound.implementation, bound.bindings, state.vocabulary
    for parameter in implementation.parameters:
        name, inferred = parameter.name, parameter.direction == "infer"
        if name not in bindings or (name in passed and not inferred):
            continue
        yield ParameterReason(
            parameter=name,
            how="passed" if name in passed else "inferred" if inferred else "default",
            conditions=_deciding_conditions(implementation, parameter, bindings, state) if inferred else (),
            others=tuple(label(other, words) for other in bound.alternatives.get(name, ())),
        )


def _deciding_conditions(
    implementation: Implementation, parameter: Parameter, bindings: Mapping[str, Value], state: WorldState
) -> tuple[DecidingCondition, ...]:
    """Return the preconditions that mention a parameter."""
    about = [each for each in implementation.pre if parameter.name in free_variables(each.condition)]
    return tuple(_make_deciding(each, bindings, state) for each in about)


def _make_deciding(requirement: Requirement, bindings: Mapping[str, Value], state: WorldState) -> DecidingCondition:
    facts = deciding_facts([requirement.condition], state, bindings)
    return DecidingCondition(text=requirement.text, source=requirement.source, facts=facts)
