"""Watches at run time what `verify never ..` lines forbid: conditions, and the contact force on the skill's arms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_compiler.library.conditions import Compare, Literal
from skillc_compiler.library.properties import Is, Measures, Property
from skillc_compiler.library.skills import Implementation
from skillc_compiler.library.vocabulary import ClassType, Vocabulary
from skillc_runtime.robots.cell import Cell
from skillc_runtime.trace.failure import Failure
from skillc_runtime.tree.enclosing import Frame
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.terms import ARM_DEVICE
from skillc_runtime.world.state.world_state import WorldState


def watched(implementation: Implementation) -> tuple[Property, ...]:
    """Return the lines that are watched while an implementation runs; the others were decided when it was compiled."""
    return tuple(
        line for line in implementation.verify if line.pattern == "never" and isinstance(line.first, Is | Measures)
    )


def violation(
    implementation: Implementation, cell: Cell, vocabulary: Vocabulary, state: WorldState, frame: Frame
) -> Failure | None:
    """Return the failure of the first line that is violated now; EvaluationError from its condition."""
    for line in watched(implementation):
        happened = _happened(line, implementation, cell, vocabulary, state, frame)
        if happened is not None:
            message = f"`{line.text}` is violated{happened}"
            return Failure(kind="verify", message=message, source=line.source, skill=implementation.skill)
    return None


def _happened(
    line: Property,
    implementation: Implementation,
    cell: Cell,
    vocabulary: Vocabulary,
    state: WorldState,
    frame: Frame,
) -> str | None:
    match line.first:
        case Is(condition=condition):
            return "" if evaluate(condition, state, frame) else None
        case Measures(operator=operator, limit=limit):
            for arm in _arms(implementation, vocabulary, frame):
                force_n = float(np.linalg.norm(cell.arm(arm).wrench[:3]))
                if evaluate(Compare(Literal(force_n), operator, limit), state, frame):
                    return f": {vocabulary.short(arm)} feels {force_n:.1f} N"
    return None


def _arms(implementation: Implementation, vocabulary: Vocabulary, frame: Frame) -> Iterator[str]:
    for parameter in implementation.parameters:
        value = frame.get(parameter.name)
        if (
            isinstance(parameter.type, ClassType)
            and isinstance(value, str)
            and vocabulary.is_a(parameter.type.iri, ARM_DEVICE)
        ):
            yield value
