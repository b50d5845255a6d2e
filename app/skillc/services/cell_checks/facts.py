"""How exactly the facts about a cell are taken, and where the place of a thing is stated."""

from __future__ import annotations

from typing import Final

from skillc_dsl.diagnostics import Severity
from skillc_runtime.primitives.known_limits import CORRECTION_M
from skillc_runtime.world.state.terms import BASE_FRAME_ID, ON, POSITION
from skillc_runtime.world.state.world_state import WorldState

ROUNDED_M: Final = 0.005
"""Things may be this far from where they would fit: numbers in files are measured and rounded."""


def severity_of(distance_m: float) -> Severity:
    """Return how bad a distance is by which something does not fit.

    A warning if things that are not quite where the world model has them may still fit, else an error.
    """
    return "warning" if distance_m <= CORRECTION_M else "error"


def placing_fact(state: WorldState, individual: str) -> str | None:
    """Return the property or relation that says where a thing is: its height, or what it is on; None without either."""
    if ON in state.facts and state.objects(individual, ON):
        return ON
    return POSITION[2] if state.value(individual, BASE_FRAME_ID) is not None else None
