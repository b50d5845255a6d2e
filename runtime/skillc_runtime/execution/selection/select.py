"""Selects the implementation of a skill for a call: the first in rank order whose parameters can be bound."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import msgspec
from msgspec import structs

from skillc_dsl.position import Position
from skillc_model.skills import Implementation, SkillLibrary
from skillc_runtime.execution.selection.binding import BoundImplementation, bind_implementation
from skillc_runtime.recording.failure import Failure, Rejection, Stage, as_failure
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

STAGES: Final[tuple[Stage, ...]] = ("argument", "inference", "pre", "hold", "lock", "start", "run")
"""How far a call gets with an implementation."""


class SelectedImplementation(msgspec.Struct, frozen=True):
    """The selected implementation, its bound parameters, and the ones rejected before it, in rank order."""

    implementation: Implementation
    bindings: dict[str, Value]
    rejected: tuple[Rejection, ...]


class NoneSelected(msgspec.Struct, frozen=True):
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
    """Explain why no implementation can run: with the reason of the one that got further than all others.

    If none got further than its arguments and preconditions, with the one reason of all, else with the reason of each.
    """
    if not rejected:
        return f"{skill} has no implementation"
    furthest = _order_by_stage(rejected)[0]
    if _was_selected(furthest):
        return f"{skill}: {as_failure(furthest, skill).message}"
    if len({rejection.reason for rejection in rejected}) == 1:
        return f"{skill}: {furthest.reason}"
    each = "; ".join(f"{rejection.implementation}: {rejection.reason}" for rejection in rejected)
    return f"no implementation of {skill} fits: {each}"


def combine_rejections(skill: str, rejected: Sequence[Rejection], source: Position) -> Failure:
    """Return the failure of the call at `source` all of whose implementations were rejected."""
    if len(rejected) == 1:
        return as_failure(rejected[0], skill)
    ordered = _order_by_stage(rejected)
    causes = tuple(
        structs.replace(as_failure(each, skill), alternative=f"{skill}[{each.implementation}]") for each in ordered
    )
    has_cause = ordered and _was_selected(ordered[0])
    message = causes[0].message if has_cause else explain_none_selected(skill, rejected)
    kind = causes[0].kind if causes else "error"
    return Failure(kind=kind, message=message, source=source, skill=skill, causes=causes)


def _was_selected(rejection: Rejection) -> bool:
    """Whether arguments and preconditions fitted."""
    return STAGES.index(rejection.stage) > STAGES.index("pre")


def _order_by_stage(rejected: Sequence[Rejection]) -> list[Rejection]:
    """Return those that got furthest first, those that got equally far in rank order."""
    return sorted(rejected, key=lambda each: -STAGES.index(each.stage))
