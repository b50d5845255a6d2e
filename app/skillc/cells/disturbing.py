"""Resolves the names in disturbances of a cell."""

from __future__ import annotations

from typing import assert_never

from msgspec.structs import replace

from skillc_runtime.devices.disturbances import Disturbance, LoseArm, Move, PressEmergencyStop, Push, Take
from skillc_runtime.world.state.names import resolve_individual
from skillc_runtime.world.state.world_state import WorldState


def resolve_names(disturbance: Disturbance, state: WorldState) -> Disturbance:
    """Return a disturbance with IRIs in place of names; NoSuchName for one that the world does not have."""
    match disturbance:
        case Push() | LoseArm():
            return replace(disturbance, arm=resolve_individual(disturbance.arm, state))
        case Move() | Take():
            return replace(disturbance, thing=resolve_individual(disturbance.thing, state))
        case PressEmergencyStop():
            return disturbance
        case _:
            assert_never(disturbance)
