"""The back end `ros2`: cells whose arms, grippers and bases are interfaces of ROS 2 that the facts name."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from functools import partial

import mujoco

from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.control_process.remote_arm import RemoteArmDriver
from skillc_runtime.backends.real_time.device_cell import CellDevices
from skillc_runtime.backends.ros2.base import Ros2Base
from skillc_runtime.backends.ros2.device_facts import Timing
from skillc_runtime.backends.ros2.facts import read_arm, read_base, read_gripper, read_inspected
from skillc_runtime.backends.ros2.gripper import Ros2Gripper
from skillc_runtime.backends.ros2.inspection import Ros2Inspection
from skillc_runtime.backends.ros2.link import Ros2Description
from skillc_runtime.backends.ros2.receiver import Feed, Receiver
from skillc_runtime.backends.simulation.scene_spec import ArmSpec, SceneSpec
from skillc_runtime.control.gains import RobotGains, UnknownController, read_gains
from skillc_runtime.devices.backend import Backend, BackendStart
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ARRIVAL_TOLERANCE
from skillc_runtime.world.state.world_state import WorldState

ARRIVAL_TOLERANCE_M = 0.05


def make_backend(world: WorldModel, start: BackendStart) -> Backend:
    """Return the cell of a world model, its arms under control and at rest.

    SheetError or FrameError if facts are missing, BackendUnavailable with what is missing on the graph of ROS 2.
    """
    state = world.snapshot()
    return open_cell(world, describe, lambda scene, arms: make_devices(state, scene, arms), observed=start.observed)


def describe(facts: ArmSpec) -> Ros2Description:
    """Return how ROS 2 drives an arm; SheetError if a fact is missing or wrong."""
    state = facts.sheet.state
    try:
        law = read_gains(facts.controller, facts.sheet.number).law
    except UnknownController as error:
        raise SheetError(f"{state.vocabulary.short(facts.individual)}: {error}") from error
    joints, on_robot = joints_of(str(facts.model)), isinstance(law, RobotGains)
    return Ros2Description(read_arm(state, facts.individual, joints, law.mode, on_robot), str(facts.model))


def make_devices(state: WorldState, scene: SceneSpec, arms: Mapping[str, RemoteArmDriver]) -> CellDevices:
    """Return grippers, mobile bases and inspection; BackendUnavailable if one of them does not answer."""
    hands = [(each.individual, each.gripper) for each in scene.arms if each.gripper is not None]
    inspected = read_inspected(state)
    if not hands and not scene.bases and not inspected:
        return CellDevices()
    with ExitStack() as opened:
        receiver = Receiver("skillc_devices")
        opened.callback(receiver.close)
        grippers: dict[str, Ros2Gripper] = {}
        bases: dict[str, Ros2Base] = {}
        firsts: list[tuple[Feed, Timing, str]] = []
        for arm, hand in hands:
            found = read_gripper(state, hand.individual, joints_of(str(hand.model)))
            grippers[hand.individual] = gripper = Ros2Gripper(hand, found, arms[arm], receiver)
            firsts.append((gripper.feed, found.timing, found.name))
        for each in scene.bases:
            interface, sheet = read_base(state, each.individual), sheet_of(state, each.individual).individual
            near_m = number_of(state, sheet, ARRIVAL_TOLERANCE, ARRIVAL_TOLERANCE_M)
            bases[each.individual] = base = Ros2Base(interface, each.pose, near_m, receiver)
            firsts.append((base.feed, interface.timing, interface.name))
        inspection = Ros2Inspection(inspected, receiver) if inspected else None
        receiver.begin()
        for feed, timing, who in firsts:
            receiver.await_first(feed, timing, who)
        opened.pop_all()
    silences = [partial(feed.find_silence, timing) for feed, timing, _ in firsts]

    def find_fault() -> str | None:
        found = (*(hand.fault for hand in grippers.values()), *(find() for find in silences))
        return next((why for why in found if why is not None), None)

    return CellDevices(
        grippers=grippers,
        bases=bases,
        inspection=inspection,
        find_fault=find_fault,
        close=receiver.close,
    )


def joints_of(file: str) -> tuple[str, ...]:
    """Return the names of the joints of a model, in its order."""
    model = mujoco.MjModel.from_xml_path(file)
    return tuple(model.joint(number).name for number in range(model.njnt))
