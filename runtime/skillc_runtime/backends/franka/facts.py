"""Reads the settings of the Franka Control Interface of an arm from the facts of the cell."""

from __future__ import annotations

from math import inf
from typing import Final

import numpy as np

from skillc_runtime.backends.franka.link import SILENCE_S, FrankaDescription
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import DRIVER_ADDRESS, FRANKA, STATE_TIMEOUT

REFLEX_TORQUES, REFLEX_FORCES = FRANKA + "reflexTorques", FRANKA + "reflexForces"
REST_TORQUE = FRANKA + "restTorque"
AXES: Final = 6
GRAVITY: Final = np.array([0.0, 0.0, -9.81])


def describe(facts: ArmSpec) -> FrankaDescription:
    """Return where the robot of an arm is, and how it is set; SheetError for a fact that is missing or wrong."""
    torques, forces = _numbers(facts, REFLEX_TORQUES, facts.home.size), _numbers(facts, REFLEX_FORCES, AXES)
    if (torques is None) != (forces is None):
        stated, missing = (REFLEX_FORCES, REFLEX_TORQUES) if torques is None else (REFLEX_TORQUES, REFLEX_FORCES)
        short = facts.sheet.state.vocabulary.short
        raise SheetError(f"{short(facts.individual)} states {short(stated)} and not {short(missing)}; state both")
    if _numbers(facts, STATE_TIMEOUT, 1) not in (None, (SILENCE_S,)):
        short = facts.sheet.state.vocabulary.short
        raise SheetError(
            f"{short(facts.individual)} states {short(STATE_TIMEOUT)}: pylibfranka waits {SILENCE_S:g} s for a state, "
            "and nothing changes that; leave it out"
        )
    rest = _numbers(facts, REST_TORQUE, 1)
    gravity = tuple((facts.base.rotation.T @ GRAVITY).tolist())
    return FrankaDescription(
        read_address(facts), facts.model, gravity, torques, forces, inf if rest is None else rest[0]
    )


def read_address(facts: ArmSpec) -> str:
    """Return the address of the robot of an arm."""
    state = facts.sheet.state
    if isinstance(address := state.value(facts.individual, DRIVER_ADDRESS), str):
        return address
    short = state.vocabulary.short
    raise SheetError(
        f"{short(facts.individual)} has no {short(DRIVER_ADDRESS)}: state the address of the robot, such as "
        f'{short(DRIVER_ADDRESS)} "192.168.1.2"'
    )


def _numbers(facts: ArmSpec, property_: str, count: int) -> tuple[float, ...] | None:
    """Return numbers above 0 of an arm, or of its data sheet; None if neither states them."""
    state = facts.sheet.state
    found = state.value(facts.individual, property_) or state.value(facts.sheet.individual, property_)
    if found is None:
        return None
    try:
        numbers = tuple(map(float, str(found).split()))
    except ValueError:
        numbers = ()
    if len(numbers) != count or min(numbers) <= 0.0:
        short, wanted = state.vocabulary.short, "a number" if count == 1 else f"{count} numbers"
        raise SheetError(f"{short(property_)} of {short(facts.individual)} must be {wanted} above 0: {found!r}")
    return numbers
