"""The back end `franka`: cells whose arms are controlled through the Franka Control Interface."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from math import inf
from typing import Final

import numpy as np

from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.franka.hand import FrankaHand
from skillc_runtime.backends.franka.library import load_library
from skillc_runtime.backends.franka.link import SILENCE_S, FrankaDescription
from skillc_runtime.backends.real_time.device_cell import CellDevices
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.devices.backend import Backend, BackendStart, DeviceStop, find_first_stop
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DRIVER_ADDRESS, FRANKA, STATE_TIMEOUT

REFLEX_TORQUES, REFLEX_FORCES = FRANKA + "reflexTorques", FRANKA + "reflexForces"
REST_TORQUE = FRANKA + "restTorque"
AXES: Final = 6
GRAVITY: Final = np.array([0.0, 0.0, -9.81])


def make_backend(world: WorldModel, start: BackendStart) -> Backend:
    """Return the cell of a world model, its arms under control and at rest.

    SheetError or FrameError if facts are missing, BackendUnavailable if a robot or pylibfranka is.
    """
    load_library()
    return open_cell(world, describe, make_devices, observed=start.observed)


def make_devices(scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
    """Return the hands of the arms."""
    with ExitStack() as opened:
        hands: dict[str, FrankaHand] = {}
        for facts in scene.arms:
            if facts.gripper is not None:
                hand = FrankaHand(facts.gripper, _read_address(facts), arms[facts.individual])
                opened.callback(hand.close)
                hands[facts.gripper.individual] = hand
        closing = opened.pop_all()

    def recover() -> None:
        for hand in hands.values():
            hand.recover()

    def find_fault() -> DeviceStop | None:
        return find_first_stop((individual, hand.fault) for individual, hand in hands.items())

    return CellDevices(grippers=hands, find_fault=find_fault, recover=recover, close=closing.close)


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
        _read_address(facts), facts.model, gravity, torques, forces, inf if rest is None else rest[0]
    )


def _read_address(facts: ArmSpec) -> str:
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
