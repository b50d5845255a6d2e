"""What an arm can follow is found out before it moves: in range, near enough, and slowly enough for every joint."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

import skillc_ontology
from skillc_runtime.control.feasibility import SlowedTrajectory, slow_to_feasible
from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.motion.reference import Trajectory

ROBOTS = Path(skillc_ontology.__file__).parent / "robots"
HOMES = {
    "iiwa14": [0.0, 0.5, 0.0, -1.6, 0.0, 1.04, 0.0],
    "ur5e": [0.0, -1.9, 2.2, -1.87, -1.5708, 0.0],
    "panda": [0.0, -0.3, 0.0, -2.1, 0.0, 1.8, 0.785],
}
FAST = MotionLimits(0.5, 0.5)


@pytest.fixture(params=sorted(HOMES))
def robot(request: pytest.FixtureRequest) -> tuple[VirtualArm, Array, ArmLimits]:
    model = load_virtual_model(ROBOTS / f"{request.param}.xml")
    arm, q = VirtualArm(model), np.array(HOMES[request.param])
    arm.update_kinematics(q)
    many = np.ones(q.size)
    return arm, q, ArmLimits(model.jnt_range.copy(), 2.0 * many, 100.0 * many, np.inf * many)


def line(arm: VirtualArm, *way: float, turn: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Trajectory:
    start = arm.tool
    return path_through([start, Pose(start.position + np.array(way), exp(np.array(turn)) @ start.rotation)], FAST)


def test_what_fits_stays_as_it_is(robot: tuple[VirtualArm, Array, ArmLimits]) -> None:
    arm, q, limits = robot
    motion = line(arm, 0.05, 0.1, -0.05, turn=(0.0, 0.2, 0.3))
    assert slow_to_feasible(arm, motion, q, limits)[0] is motion


def test_what_is_out_of_reach_is_told_with_the_place(robot: tuple[VirtualArm, Array, ArmLimits]) -> None:
    arm, q, limits = robot
    with pytest.raises(Infeasible, match=r"at \(.*\) m from the arm's base its tool would be \d+ mm"):
        slow_to_feasible(arm, line(arm, 1.5, 0.0, 0.0), q, limits)


def test_a_joint_that_would_leave_its_range_is_named(robot: tuple[VirtualArm, Array, ArmLimits]) -> None:
    arm, q, limits = robot
    tight = limits.range.copy()
    tight[0] = q[0] - 0.1, q[0] + 0.1
    with pytest.raises(
        Infeasible, match=r"(joint1|shoulder_pan) would have to be at -?0\.1\d rad, outside its range from -0\.10 to"
    ):
        slow_to_feasible(arm, line(arm, 0.0, 0.3, 0.0), q, replace(limits, range=tight))


def test_a_joint_that_would_be_too_fast_slows_the_motion_down(robot: tuple[VirtualArm, Array, ArmLimits]) -> None:
    arm, q, limits = robot
    motion, slow = line(arm, 0.0, 0.2, 0.0), replace(limits, velocity=np.full(q.size, 0.2))
    slower, _ = slow_to_feasible(arm, motion, q, slow)
    assert isinstance(slower, SlowedTrajectory)
    assert slower.factor > 1.5
    assert slow_to_feasible(arm, slower, q, replace(slow, velocity=slow.velocity * 1.05))[0] is slower
    half = slower.at(slower.duration / 2)
    there = motion.at(motion.duration / 2)
    assert np.allclose(half.pose.position, there.pose.position)
    assert np.allclose(half.twist * slower.factor, there.twist)
    assert np.allclose(half.acceleration * slower.factor**2, there.acceleration)


def test_a_pressed_tool_whose_motion_starts_in_the_air_follows_it_near_a_singularity() -> None:
    """As where a wrist joint is near 0 and the reference of a pressed tool is 7 cm above the surface."""
    model = load_virtual_model(ROBOTS / "ur5e.xml")
    arm, many = VirtualArm(model), np.ones(6)
    above, pressed = (
        np.array([-1.24, -2.32, 2.59, -0.93, 0.04, -0.91]),
        np.array([-0.86, -1.91, 2.36, -0.5, 0.41, -1.52]),
    )
    arm.update_kinematics(above)
    motion = line(arm, 0.0, 0.02, 0.0)
    limits = ArmLimits(model.jnt_range.copy(), 2.0 * many, 100.0 * many, np.inf * many)
    _, joints = slow_to_feasible(arm, motion, pressed, limits)
    arm.update_kinematics(joints[-1])
    assert np.allclose(arm.tool.position, motion.at(motion.duration).pose.position, atol=0.003)
