"""A whole cell behind topics: it moves, and each way in which the other side fails ends at rest, with the cause."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from robots.ros2.running import Robot, robot
from robots.ros2.test_link import IN_ROS, SCENE
from simulation.cells import LAB, vocabulary
from skillc_runtime.backends.control_process.handshake import Patience
from skillc_runtime.backends.control_process.opening import open_cell
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.backends.ros2.cell import describe
from skillc_runtime.backends.ros2.devices import make_devices
from skillc_runtime.backends.ros2.session import Session
from skillc_runtime.devices.backend import BackendBroken, StopPersists
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

pytestmark = pytest.mark.slow

ARM, HAND = LAB + "Arm-1", LAB + "Hand-1"
PATIENT = Patience(tree_s=5.0, process_s=5.0, gap_s=5.0)
"""Machines that run tests beside each other are slow."""
LIMITS = MotionLimits(speed=0.15, acceleration=0.4)


@contextmanager
def opened(scene: Path = SCENE, patience: Patience = PATIENT) -> Iterator[DeviceCell]:
    with opened_state(load_scene(scene, vocabulary()), patience) as cell:
        yield cell


@contextmanager
def opened_state(state: WorldState, patience: Patience = PATIENT) -> Iterator[DeviceCell]:
    world = WorldModel(state)
    cell = open_cell(world, describe, lambda spec, arms: make_devices(world, spec, arms), patience)
    try:
        yield cell
    finally:
        cell.close()


def advance_until(cell: DeviceCell, holds: Callable[[], bool], seconds: float = 30.0) -> None:
    end = cell.now + seconds
    while not holds():
        assert cell.now < end
        cell.advance(0.02)


def go_up(cell: DeviceCell, way_m: float = 0.1, limits: MotionLimits = LIMITS) -> Any:
    """Begin to move the tool up, and return where it will be."""
    motion = cell.arm(ARM).motion
    start = motion.stopping_pose()
    goal = Pose(start.position + way_m * np.eye(3)[2], start.rotation)
    motion.move_along(path_through([start, goal], limits))
    return goal.position


WAYS = {
    "position": "",
    "trajectory": """lab:Arm-1 skiros:JointConfigurationController "joint_trajectory_controller" ;
        ros2:commandType "trajectory_msgs/msg/JointTrajectory" .""",
    "velocity": "",
}
"""Facts that the controllers of the robot need."""


@pytest.mark.parametrize(
    "control", ["position", *(pytest.param(each, marks=pytest.mark.long) for each in ("trajectory", "velocity"))]
)
def test_joints_tool_and_fingers_move_with_jitter_and_loss(control: str, tmp_path: Path) -> None:
    scene, text = tmp_path / "cell.ttl", SCENE.read_text("utf-8")
    if control == "velocity":
        text = text.replace('"forward_dynamics"', '"forward_dynamics_velocity"')
    scene.write_text(f"{text}\n{WAYS[control]}\n", "utf-8")
    channel = {"control": control, "jitter_s": 0.004, "loss": 0.05, "seed": 3}
    with robot(scene, tmp_path, rate_hz=125, joint_names=IN_ROS, reverse=True, **channel) as there:
        with opened(scene) as cell:
            arm, hand = cell.arm(ARM), cell.gripper(HAND)
            assert cell.stops.report is None
            goal = arm.measured.q + np.array([0.2, 0.0, 0.0, 0.0, 0.0, -0.3])
            arm.motion.move_joints(goal, 0.15)
            hand.move(0.08, 30.0)
            advance_until(cell, lambda: bool(np.abs(arm.measured.q - goal).max() < 0.01) and not hand.moving)
            assert hand.opening_m == pytest.approx(0.08, abs=0.003)
            place = go_up(cell)
            advance_until(cell, lambda: bool(np.abs(arm.measured.pose.position - place).max() < 0.005))
            assert arm.take_fault() is None
        report = there.end()
    assert report["commands"] > 100
    assert report["lost"] > 0
    assert (report["beyond_limits"], report["examples"]) == (0, [])


@pytest.fixture(scope="module")
def there(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Robot]:
    with robot(SCENE, tmp_path_factory.mktemp("robot"), rate_hz=125, joint_names=IN_ROS) as found:
        yield found


def is_stopped(cell: DeviceCell) -> bool:
    """Let time pass; tell whether the cell has stopped."""
    try:
        cell.advance(0.02)
    except BackendBroken:
        return True
    return False


def wait_for_stop(cell: DeviceCell) -> str:
    """Let time pass until the cell has stopped, and return why."""
    end = cell.now + 30.0
    while not is_stopped(cell):
        assert cell.now < end
    report = cell.stops.report
    assert report is not None
    return report.reason


def test_a_robot_that_is_silent_in_a_motion_stops_the_cell_and_is_used_again_afterwards(there: Robot) -> None:
    with opened() as cell:
        place = go_up(cell, limits=MotionLimits(speed=0.05, acceleration=0.2))
        advance_until(cell, lambda: bool(np.linalg.norm(cell.arm(ARM).measured.velocity[:3]) > 0.03))
        there.pause()
        try:
            assert "has been silent for" in wait_for_stop(cell)
        finally:
            there.go_on()
        advance_until(cell, lambda: not _persists(cell))
        rested = cell.arm(ARM).measured.pose.position
        assert rested[2] < place[2] - 0.01
        assert go_up(cell, 0.02)[2] == pytest.approx(rested[2] + 0.02, abs=0.01)
        advance_until(cell, lambda: cell.is_at_rest() and cell.arm(ARM).motion.done)


def _persists(cell: DeviceCell) -> bool:
    try:
        cell.stops.clear()
    except StopPersists:
        return True
    return False


def test_a_program_that_stops_in_a_motion_and_a_second_one_stop_the_cell(there: Robot) -> None:
    with opened() as cell:
        session = Session("operator")
        try:
            go_up(cell, -0.05)
            assert session.call("/stop_program", 10.0) is None
            assert "/robot_program_running says that commands have no effect" in wait_for_stop(cell)
            advance_until(cell, lambda: not _persists(cell))
            go_up(cell, 0.05)
            session.publish("/forward_position_controller/commands", "std_msgs/msg/Float64MultiArray", reliable=True)
            assert "publishes commands to /forward_position_controller/commands as well" in wait_for_stop(cell)
        finally:
            session.close()


def test_nothing_was_commanded_beyond_limits(there: Robot) -> None:
    report = there.end()
    assert report["commands"] > 100
    assert (report["beyond_limits"], report["examples"]) == (0, [])
