"""What a surface says of contact to work with: how hard a tool must be pressed on it, and for how much of the time."""

from __future__ import annotations

from skillc_runtime.world.sheet import number
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.terms import LEAST_CONTACT, LEAST_FORCE

LEAST_FORCE_N, LEAST_SHARE = 1.0, 0.75
"""For surfaces that do not say it."""


def least_force_n(state: WorldState, surface: str) -> float:
    """Return the force in N below which a tool does nothing to a surface."""
    return number(state, surface, LEAST_FORCE, default=LEAST_FORCE_N)


def least_contact(state: WorldState, surface: str) -> float:
    """Return the share of the time, along a path, in which a tool must be pressed on a surface."""
    return number(state, surface, LEAST_CONTACT, default=LEAST_SHARE)
