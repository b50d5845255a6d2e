"""Connects to a gripper by the protocol and the address that the facts state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from skillc_runtime.backends.devices.fingers import FingerDevice, Fingers
from skillc_runtime.backends.devices.measured_gripper import Hold
from skillc_runtime.backends.devices.robotiq import STEPS, RobotiqFingers
from skillc_runtime.backends.devices.wsg import WsgFingers
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.terms import COMMAND_STEPS, DRIVER_ADDRESS, GRIPPER_PROTOCOL
from skillc_runtime.world.state.world_state import WorldState

ROBOTIQ: Final = "robotiq-urcap"
WSG: Final = "wsg-text"


def open_gripper(
    state: WorldState,
    gripper: GripperSpec,
    arm_address: str,
    hold: Hold,
    let_go: Callable[[], None],
    observed: bool = False,
) -> Fingers:
    """Return a gripper that is connected, and ready to move unless it is only `observed`.

    One behind its arm's controller needs no address of its own.

    SheetError if its sheet names no protocol that is known; BackendUnavailable if it does not answer.
    """
    return Fingers(_device(state, gripper, arm_address), gripper, hold, let_go, observed)


def _device(state: WorldState, gripper: GripperSpec, arm_address: str) -> FingerDevice:
    individual, short = gripper.individual, state.vocabulary.short
    sheet = sheet_of(state, individual)
    protocol = state.value(sheet.individual, GRIPPER_PROTOCOL)
    address = state.value(individual, DRIVER_ADDRESS)
    where = arm_address if address is None else str(address)
    match protocol:
        case "robotiq-urcap":
            steps = round(number_of(state, sheet.individual, COMMAND_STEPS, STEPS))
            return RobotiqFingers(short(individual), where, gripper, steps)
        case "wsg-text" if address is not None:
            return WsgFingers(short(individual), where, gripper)
        case "wsg-text":
            raise SheetError(
                f"where {short(individual)} is on the network is not stated: write {short(DRIVER_ADDRESS)} with its "
                "address at it in the scene"
            )
    raise SheetError(
        f"{short(sheet.individual)} does not say how {short(individual)} is driven: {short(GRIPPER_PROTOCOL)} is "
        f'"{ROBOTIQ}" or "{WSG}"' + ("" if protocol is None else f", not {protocol!r}")
    )
