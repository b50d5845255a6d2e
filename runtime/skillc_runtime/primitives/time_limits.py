"""How long primitives wait for devices: a device that never arrives is a failure, not an endless wait."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState

SETTLING_S = 3.0
"""How long fingers may take to come to rest after the time in which they open all the way."""

STANDSTILL_S = 5.0
"""How long an arm may stand still before the end of its motion."""

SLOWER = 3.0
"""A device may be slower than its nominal speed by this factor."""

STARTING_S = 5.0
"""How long a device may take to accelerate, brake and report that it has arrived."""


def finger_limit_s(state: WorldState, gripper: str, stroke_m: float) -> float:
    """Return how long fingers may move, if they open by up to `stroke_m` m; SkillFailure without their speed."""
    return stroke_m / _speed(state, gripper, "fingerSpeed") + SETTLING_S


def drive_limit_s(state: WorldState, robot: str, distance_m: float, share: float) -> float:
    """Return how long a base may drive a distance, with a full turn on the way, with a share of its speeds.

    SkillFailure without its speeds.
    """
    nominal_s = distance_m / _speed(state, robot, "driveSpeed") + 2 * pi / _speed(state, robot, "turnSpeed")
    return SLOWER * nominal_s / share + STARTING_S


def approach_limit_s(travel_m: float, approach_m_s: float) -> float:
    """Return how long a tool may approach a surface that is up to `travel_m` m away."""
    return SLOWER * travel_m / approach_m_s + STARTING_S


def describe_slowness(share: float) -> str:
    """Return what to add to the message of a time-out in a run with a share of the speeds; empty at full speed."""
    return "" if share == 1.0 else f"; the run has {100.0 * share:.3g} % of the speeds, which may be why"


def _speed(state: WorldState, device: str, name: str) -> float:
    try:
        return sheet_of(state, device).number(name)
    except SheetError as error:
        raise SkillFailure(str(error)) from error
