"""A cell of arms of Universal Robots, with their grippers and what is wired to their controllers."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial

from skillc_runtime.backends.control_process.handshake import USUAL_PATIENCE, Patience
from skillc_runtime.backends.control_process.link import RobotLink
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.devices.fingers import Fingers
from skillc_runtime.backends.devices.gripper_facts import open_gripper
from skillc_runtime.backends.real_time.device_cell import CellDevices, DeviceCell
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.backends.ur.facts import UrFacts, read_address, read_facts
from skillc_runtime.backends.ur.io import UrIo
from skillc_runtime.backends.ur.library import load_library
from skillc_runtime.backends.ur.wiring import WiredPoint, read_wires
from skillc_runtime.devices.backend import BackendStart, BackendUnavailable, DeviceStop, StopPersists, find_first_stop
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class UrDescription:
    """One arm, implementing `LinkDescription`."""

    facts: UrFacts

    @property
    def name(self) -> str:
        """The arm and its address."""
        return self.facts.name

    def make_link(self) -> RobotLink:
        """Return a link that is not connected; BackendUnavailable without ur-rtde."""
        for module in ("rtde_control", "rtde_receive"):
            load_library(module)
        from skillc_runtime.backends.ur.link import UrLink

        return UrLink(self.facts)


def make_backend(world: WorldModel, start: BackendStart) -> DeviceCell:
    """Return a cell of arms of Universal Robots; it is `MakeBackend`."""
    return open_arms(world, observed=start.observed)


def open_arms(
    world: WorldModel,
    patience: Patience = USUAL_PATIENCE,
    inspection: Camera | None = None,
    observed: bool = False,
) -> DeviceCell:
    """Return the cell of a world model; `inspection` is the camera that inspects surfaces, where there is one.

    With `observed` nothing is taken under control, and no gripper is activated.
    """
    state = world.snapshot()

    def describe(facts: ArmSpec) -> UrDescription:
        return UrDescription(read_facts(state, facts))

    def make_devices(scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
        return replace(_open_devices(state, scene, arms, observed), inspection=inspection)

    return open_cell(world, describe, make_devices, patience, observed)


def _open_devices(
    state: WorldState, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver], observed: bool
) -> CellDevices:
    """Connect to grippers, and to the inputs and outputs of the controller where something is wired to them."""
    with ExitStack() as opened:
        grippers: dict[str, Fingers] = {}
        for facts in scene.arms:
            if facts.gripper is None:
                continue
            arm, address = arms[facts.individual], read_address(state, facts.individual)
            let_go = partial(arm.set_load, None)
            fingers = open_gripper(state, facts.gripper, address, arm.hold, let_go, observed)
            opened.callback(fingers.close)
            grippers[facts.gripper.individual] = fingers
        wires = read_wires(state)
        io = _open_io(state, scene, opened) if wires else None
        points = {} if io is None else {each: WiredPoint(io, wire) for each, wire in wires.items()}
        closing = opened.pop_all()

    watched: dict[str, Fingers | UrIo] = dict(grippers)
    if io is not None:
        watched[scene.arms[0].individual] = io

    def find_fault() -> DeviceStop | None:
        return find_first_stop((device, each.find_fault()) for device, each in watched.items())

    def recover() -> None:
        try:
            for each in watched.values():
                each.recover()
        except BackendUnavailable as error:
            raise StopPersists(str(error)) from error

    return CellDevices(
        grippers=grippers,
        buttons=points,
        io_points=points,
        find_fault=find_fault,
        recover=recover,
        close=closing.close,
    )


def _open_io(state: WorldState, scene: SceneSpec, opened: ExitStack) -> UrIo:
    if len(scene.arms) != 1:
        raise SheetError("to which controller something is wired is not known where a scene has several arms")
    arm = scene.arms[0].individual
    io = UrIo(state.vocabulary.short(arm), read_address(state, arm))
    opened.callback(io.close)
    return io
