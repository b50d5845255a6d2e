"""Lets disturbances happen to a simulated cell, whose names are those of its world."""

from __future__ import annotations

from typing import assert_never

from msgspec.structs import replace

from skillc.errors import RequestError
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.disturbances import (
    Disturbance,
    DisturbanceRefused,
    LoseArm,
    MoveThing,
    PressEmergencyStop,
    PushArm,
    TakeThing,
)
from skillc_runtime.world.state.names import NoSuchName, resolve_individual
from skillc_runtime.world.state.world_state import WorldState


def disturb_cell(disturbance: Disturbance, cell: str, backend: Backend, state: WorldState) -> Disturbance:
    """Let something happen to the cell of this name; return it with IRIs. RequestError if it is not possible."""
    disturber = backend.capabilities.disturber
    if disturber is None:
        raise RequestError(f"{cell} is no simulation: what happens to it cannot be chosen")
    if backend.broken is not None:
        raise RequestError(f"nothing moves any more: {backend.broken}")
    try:
        found = _resolve_names(disturbance, state)
        disturber.disturb(found)
    except (NoSuchName, DisturbanceRefused) as error:
        raise RequestError(str(error)) from error
    return found


def _resolve_names(disturbance: Disturbance, state: WorldState) -> Disturbance:
    """Return a disturbance with IRIs in place of names; NoSuchName for one that the world does not have."""
    match disturbance:
        case PushArm() | LoseArm():
            return replace(disturbance, arm=resolve_individual(disturbance.arm, state))
        case MoveThing() | TakeThing():
            return replace(disturbance, thing=resolve_individual(disturbance.thing, state))
        case PressEmergencyStop():
            return disturbance
        case _:
            assert_never(disturbance)
