"""The back end `franka`: cells whose arms are controlled through the Franka Control Interface."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack

from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.franka.facts import describe, read_address
from skillc_runtime.backends.franka.hand import FrankaHand
from skillc_runtime.backends.franka.library import load_library
from skillc_runtime.backends.real_time.device_cell import CellDevices
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.backend import Backend, BackendStart, DeviceStop, find_first_stop
from skillc_runtime.world.state.model import WorldModel


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
                hand = FrankaHand(facts.gripper, read_address(facts), arms[facts.individual])
                opened.callback(hand.close)
                hands[facts.gripper.individual] = hand
        closing = opened.pop_all()

    def recover() -> None:
        for hand in hands.values():
            hand.recover()

    def find_fault() -> DeviceStop | None:
        return find_first_stop((individual, hand.fault) for individual, hand in hands.items())

    return CellDevices(grippers=hands, find_fault=find_fault, recover=recover, close=closing.close)
