"""Which implementation of a skill a call takes: the first in rank order that fits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from skillc_compiler.library.skills import Implementation, SkillLibrary
from skillc_runtime.selection.fit import Fitted, fit
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Selection:
    """The implementation taken, its bound parameters, and those rejected before it, in rank order."""

    implementation: Implementation
    bindings: dict[str, Value]
    rejected: tuple[Rejected, ...]


@dataclass(frozen=True, slots=True)
class NoneFits:
    """Every candidate was rejected."""

    rejected: tuple[Rejected, ...]


def candidates(library: SkillLibrary, skill: str, fixed: str | None) -> tuple[Implementation, ...]:
    """Return a skill's implementations in rank order, only `fixed` if the call fixes the choice.

    KeyError for a skill or an implementation that the library does not have.
    """
    if fixed is not None:
        return (library.implementations[f"{skill}.{fixed}"],)
    return library.implementations_of(skill)


def select(
    library: SkillLibrary, skill: str, arguments: Mapping[str, Value], state: WorldState, fixed: str | None = None
) -> Selection | NoneFits:
    """Return the choice a call would make in this state, without starting anything."""
    rejected: list[Rejected] = []
    for implementation in candidates(library, skill, fixed):
        match fit(implementation, arguments, state):
            case Fitted(bindings=bindings):
                return Selection(implementation, bindings, tuple(rejected))
            case Rejected() as refusal:
                rejected.append(refusal)
    return NoneFits(tuple(rejected))


def why_none(skill: str, rejected: Sequence[Rejected]) -> str:
    """Say why no implementation fits: the reason itself when all have the same, else each with its own."""
    reasons = {refusal.reason for refusal in rejected}
    if not rejected:
        return f"{skill} has no implementation"
    if len(reasons) == 1:
        return f"{skill}: {rejected[0].reason}"
    each = "; ".join(f"{refusal.implementation}: {refusal.reason}" for refusal in rejected)
    return f"no implementation of {skill} fits: {each}"
