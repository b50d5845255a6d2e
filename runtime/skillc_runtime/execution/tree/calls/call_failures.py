"""What a call makes of a failure inside it: its own failure, or the rejection of an implementation."""

from __future__ import annotations

from msgspec import structs

from skillc_dsl.position import Position
from skillc_model.skills import Implementation
from skillc_runtime.recording.failure import Failure, Rejection


def make_call_failure(failure: Failure | None, name: str, source: Position, skill: str) -> Failure:
    """Return the failure of a body as that of its call, with the name of the skill if the failure has none."""
    if failure is None:
        return Failure(kind="body", message=f"{name} failed", source=source, skill=skill)
    return failure if failure.skill else structs.replace(failure, skill=skill)


def reject_implementation(implementation: Implementation, failure: Failure, ran: bool = False) -> Rejection:
    """Return the rejection of an implementation that could not start, or that has run and failed."""
    return Rejection(
        implementation=implementation.name,
        stage="run" if ran else "start",
        reason=failure.message,
        source=failure.source or implementation.source,
        failure=failure,
    )
