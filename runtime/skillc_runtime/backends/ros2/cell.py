"""The back end `ros2`: cells whose arms, grippers and bases are interfaces of ROS 2 that the facts name."""

from __future__ import annotations

from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.ros2.arms.link import Ros2Description
from skillc_runtime.backends.ros2.devices import joints_of, make_devices
from skillc_runtime.backends.ros2.facts import read_arm
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.control.gains import RobotGains, UnknownController, read_gains
from skillc_runtime.devices.backend import Backend, BackendStart
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel


def make_backend(world: WorldModel, start: BackendStart) -> Backend:
    """Return the cell of a world model, its arms under control and at rest.

    SheetError or FrameError if facts are missing, BackendUnavailable with what is missing on the graph of ROS 2.
    """
    return open_cell(world, describe, lambda scene, arms: make_devices(world, scene, arms), observed=start.observed)


def describe(facts: ArmSpec) -> Ros2Description:
    """Return how ROS 2 drives an arm; SheetError if a fact is missing or wrong."""
    state = facts.sheet.state
    try:
        law = read_gains(facts.controller, facts.sheet.number).law
    except UnknownController as error:
        raise SheetError(f"{state.vocabulary.short(facts.individual)}: {error}") from error
    joints, on_robot = joints_of(str(facts.model)), isinstance(law, RobotGains)
    return Ros2Description(read_arm(state, facts.individual, joints, law.mode, on_robot), str(facts.model))
