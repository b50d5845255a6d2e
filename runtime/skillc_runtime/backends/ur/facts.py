"""Where an arm of Universal Robots is, and how it is to be driven: facts of the arm."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Final

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.world.state.data_sheet import SheetError, number_of, text_of
from skillc_runtime.world.state.terms import (
    DRIVER_ADDRESS,
    POSITION_CONTROLLED_ARM,
    STATE_TIMEOUT,
    TORQUE_CONTROLLED_ARM,
    UR,
    VELOCITY_CONTROLLED_ARM,
)
from skillc_runtime.world.state.world_state import WorldState

JOINTS: Final = 6
"""Of every arm of Universal Robots."""


@dataclass(frozen=True, slots=True)
class ServoFacts:
    """How the controller follows: gain and look-ahead time in s of `servoj`; acceleration in rad/s^2 of `speedj`.

    stop_rad_s2: how the controller brakes when control is given back.
    """

    gain: float
    lookahead_s: float
    acceleration_rad_s2: float
    stop_rad_s2: float


@dataclass(frozen=True, slots=True)
class UrFacts:
    """One arm.

    silence_s: how long it may be silent. command_timeout_s: how long the controller waits for a command before it stops
    the arm. model: MJCF of the arm; the flange that it gives, and the one that the controller gives, may be
    `tolerance_m` and `tolerance_rad` apart. offset_n: up to which force what a sensor measures first counts as its
    offset.
    """

    arm: str
    address: str
    servo: ServoFacts
    silence_s: float
    command_timeout_s: float
    model: Path
    tolerance_m: float
    tolerance_rad: float
    offset_n: float

    @property
    def name(self) -> str:
        """The arm and its address."""
        return f"{self.arm} at {self.address}"


def read_facts(state: WorldState, arm: ArmSpec) -> UrFacts:
    """Read the facts of an arm; what it does not state its data sheet may.

    SheetError without address, if it has another number of joints, or if it takes joint torques.
    """
    _check_kind(arm, state.vocabulary)
    individual, sheet = arm.individual, arm.sheet

    def number(name: str, default: float) -> float:
        return number_of(state, individual, name, number_of(state, sheet.individual, name, default))

    return UrFacts(
        arm=state.vocabulary.short(individual),
        address=read_address(state, individual),
        servo=ServoFacts(
            gain=number(UR + "servoGain", 300.0),
            lookahead_s=number(UR + "lookaheadTime", 0.1),
            acceleration_rad_s2=number(UR + "jointAcceleration", 10.0),
            stop_rad_s2=number(UR + "stopDeceleration", 10.0),
        ),
        silence_s=number(STATE_TIMEOUT, 0.1),
        command_timeout_s=number(UR + "commandTimeout", 0.1),
        model=sheet.model,
        tolerance_m=number(UR + "flangeTolerance", 0.005),
        tolerance_rad=number(UR + "flangeAngleTolerance", 0.02),
        offset_n=number(UR + "offsetForce", 8.0),
    )


def _check_kind(arm: ArmSpec, vocabulary: Vocabulary) -> None:
    """Raise SheetError for an arm that no controller of Universal Robots moves, or not as it is to be moved."""
    short = vocabulary.short
    if arm.home.size != JOINTS:
        raise SheetError(
            f"{short(arm.individual)} has {arm.home.size} joints by {short(arm.sheet.individual)}, an arm of Universal "
            f"Robots has {JOINTS}: is that the data sheet of another arm?"
        )
    if "torque" in arm.modes:
        raise SheetError(
            f"{short(arm.individual)} is a {short(TORQUE_CONTROLLED_ARM)}, and the back end `ur` sends no joint "
            f"torques: an emulated arm ran away under them. Its class must be a {short(POSITION_CONTROLLED_ARM)} or a "
            f"{short(VELOCITY_CONTROLLED_ARM)}"
        )


def read_address(state: WorldState, device: str) -> str:
    """Return where a device is; SheetError, with what to write, if nobody has stated that."""
    short = state.vocabulary.short
    if state.value(device, DRIVER_ADDRESS) is None:
        raise SheetError(
            f"where {short(device)} is on the network is not stated: write "
            f'{short(DRIVER_ADDRESS)} "192.168.1.2", with its own address, at {short(device)} in the scene'
        )
    return text_of(state, device, DRIVER_ADDRESS)
