"""Checks `verify never ...` lines at run time: conditions, and the contact force on the skill's arms."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_model.conditions import Compare, Literal
from skillc_model.properties import ConditionEvent, Measures, Property
from skillc_model.skills import Implementation
from skillc_rdf.vocabulary.types import ClassType, Vocabulary
from skillc_runtime.devices.cell import Cell
from skillc_runtime.execution.tree.lexical_scope import Frame
from skillc_runtime.motion.arrays import np
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.terms import ARM_DEVICE
from skillc_runtime.world.state.world_state import WorldState


def monitored_properties(implementation: Implementation) -> tuple[Property, ...]:
    """Return the `verify` lines that are checked while an implementation runs; the compiler checks the others."""
    return tuple(
        line
        for line in implementation.verify
        if line.pattern == "never" and isinstance(line.first, ConditionEvent | Measures)
    )


def find_violation(
    implementation: Implementation, cell: Cell, vocabulary: Vocabulary, state: WorldState, frame: Frame
) -> Failure | None:
    """Return the failure of the first `verify` line that is violated now, if any.

    Raises EvaluationError if a condition cannot be evaluated."""
    for line in monitored_properties(implementation):
        violation = _describe_violation(line, implementation, cell, vocabulary, state, frame)
        if violation is not None:
            message = f"`{line.text}` is violated{violation}"
            return Failure(kind="verify", message=message, source=line.source, skill=implementation.skill)
    return None


def _describe_violation(
    line: Property,
    implementation: Implementation,
    cell: Cell,
    vocabulary: Vocabulary,
    state: WorldState,
    frame: Frame,
) -> str | None:
    match line.first:
        case ConditionEvent(condition=condition):
            return "" if evaluate(condition, state, frame) else None
        case Measures(operator=operator, limit=limit):
            for arm in _find_arms(implementation, vocabulary, frame):
                felt = cell.arm(arm).measured.felt
                if felt is None:
                    return f": {vocabulary.short(arm)} has nothing that measures its force"
                force_n = float(np.linalg.norm(felt[:3]))
                if evaluate(Compare(Literal(force_n), operator, limit), state, frame):
                    return f": {vocabulary.short(arm)} measures {force_n:.1f} N"
    return None


def _find_arms(implementation: Implementation, vocabulary: Vocabulary, frame: Frame) -> Iterator[str]:
    for parameter in implementation.parameters:
        value = frame.get(parameter.name)
        if (
            isinstance(parameter.type, ClassType)
            and isinstance(value, str)
            and vocabulary.is_a(parameter.type.iri, ARM_DEVICE)
        ):
            yield value
