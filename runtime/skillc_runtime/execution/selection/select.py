"""Selects the implementation of a skill for a call: the first in rank order whose parameters can be bound."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from skillc_model.skills import Implementation, SkillLibrary
from skillc_runtime.execution.selection.binding import BoundImplementation, bind_implementation
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class SelectedImplementation:
    """The selected implementation, its bound parameters, and the ones rejected before it, in rank order."""

    implementation: Implementation
    bindings: dict[str, Value]
    rejected: tuple[Rejection, ...]


@dataclass(frozen=True, slots=True)
class NoneSelected:
    """All implementations were rejected."""

    rejected: tuple[Rejection, ...]


def ranked_implementations(library: SkillLibrary, skill: str, fixed: str | None) -> tuple[Implementation, ...]:
    """Return a skill's implementations in rank order; only `fixed` if the call names one.

    KeyError for a skill or an implementation that the library does not have.
    """
    if fixed is not None:
        return (library.implementations[f"{skill}.{fixed}"],)
    return library.implementations_of(skill)


def select_implementation(
    library: SkillLibrary, skill: str, arguments: Mapping[str, Value], state: WorldState, fixed: str | None = None
) -> SelectedImplementation | NoneSelected:
    """Return the selection of a call in this state, without starting anything."""
    rejected: list[Rejection] = []
    for implementation in ranked_implementations(library, skill, fixed):
        match bind_implementation(implementation, arguments, state):
            case BoundImplementation(bindings=bindings):
                return SelectedImplementation(implementation, bindings, tuple(rejected))
            case Rejection() as rejection:
                rejected.append(rejection)
    return NoneSelected(tuple(rejected))


def explain_none_selected(skill: str, rejected: Sequence[Rejection]) -> str:
    """Explain why no implementation can run: with one reason if all have the same, else with the reason of each."""
    reasons = {rejection.reason for rejection in rejected}
    if not rejected:
        return f"{skill} has no implementation"
    if len(reasons) == 1:
        return f"{skill}: {rejected[0].reason}"
    each = "; ".join(f"{rejection.implementation}: {rejection.reason}" for rejection in rejected)
    return f"no implementation of {skill} fits: {each}"
