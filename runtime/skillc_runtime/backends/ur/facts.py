"""Where an arm of Universal Robots is, and how it is to be driven: facts of the arm."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skillc_runtime.devices.arm import Mode
from skillc_runtime.world.state.data_sheet import DataSheet, SheetError, number_of, text_of
from skillc_runtime.world.state.terms import (
    DRIVER_ADDRESS,
    POSITION_CONTROLLED_ARM,
    STATE_TIMEOUT,
    TORQUE_CONTROLLED_ARM,
    UR,
    VELOCITY_CONTROLLED_ARM,
)
from skillc_runtime.world.state.world_state import WorldState


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


def read_facts(state: WorldState, arm: str, sheet: DataSheet, modes: tuple[Mode, ...]) -> UrFacts:
    """Read the facts of an arm, by IRI; what it does not state its data sheet may.

    SheetError without address, or if the arm takes joint torques: an arm under a law of torques has run away.
    """
    if "torque" in modes:
        short = state.vocabulary.short
        raise SheetError(
            f"{short(arm)} is a {short(TORQUE_CONTROLLED_ARM)}, and the back end `ur` sends no joint torques: an "
            f"emulated arm ran away under them. Its class must be a {short(POSITION_CONTROLLED_ARM)} or a "
            f"{short(VELOCITY_CONTROLLED_ARM)}"
        )

    def number(name: str, default: float) -> float:
        return _number(state, arm, sheet, UR + name, default)

    return UrFacts(
        arm=state.vocabulary.short(arm),
        address=read_address(state, arm),
        servo=ServoFacts(
            gain=number("servoGain", 300.0),
            lookahead_s=number("lookaheadTime", 0.1),
            acceleration_rad_s2=number("jointAcceleration", 10.0),
            stop_rad_s2=number("stopDeceleration", 10.0),
        ),
        silence_s=_number(state, arm, sheet, STATE_TIMEOUT, 0.1),
        command_timeout_s=number("commandTimeout", 0.1),
        model=sheet.model,
        tolerance_m=number("flangeTolerance", 0.005),
        tolerance_rad=number("flangeAngleTolerance", 0.02),
        offset_n=number("offsetForce", 8.0),
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


def _number(state: WorldState, arm: str, sheet: DataSheet, property_: str, default: float) -> float:
    """Return a number of an arm, or else of its data sheet."""
    return number_of(state, arm, property_, number_of(state, sheet.individual, property_, default))
