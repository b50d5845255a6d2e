"""An arm whose signals become wrong comes to rest without them, says which are wrong, and goes on once acknowledged."""

from __future__ import annotations

import numpy as np
import pytest

from simulation.cells import ARM, cell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.arms.signal_faults import FaultKind, SignalFault
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Array, Pose

ARMS = ("iiwa_table", "ur5e_whiteboard")
CAUSES: dict[FaultKind, str] = {
    "all-frozen": "signals are frozen",
    "all-intermittent": "signals are frozen",
    "position-jumps": "position of joint 2 jumps by 0.300 rad",
    "speed-negated": "have become the opposite",
    "speed-out-of-range": "joint 2 is measured to move with 20.0 rad/s",
}
WRENCH_CAUSES: dict[FaultKind, str] = {
    "wrench-frozen": "exactly the same while the arm moves",
    "wrench-zero": "exactly the same while the arm moves",
    "wrench-jumps": "jumps by 300 N",
}


def moving(scene: str) -> SimulatedCell:
    """Return a cell whose arm is on its way upwards with 0.1 m/s, and has reached that speed."""
    there = cell(scene)
    arm = there.arm(ARM[scene])
    start = arm.motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, 0.0, 0.1]), start.rotation)
    arm.motion.move_along(path_through((start, goal), MotionLimits(0.1, 0.5)))
    there.advance(0.4)
    return there


def speeds(there: SimulatedCell, scene: str) -> Array:
    """Return how fast the joints really move, in rad/s."""
    dofs = there.arms[ARM[scene]]._dofs
    return there.data.qvel[dofs].copy()


def falsified(there: SimulatedCell, scene: str, kind: FaultKind) -> float:
    """Let signals be wrong from now on; return after how many s the arm stops by itself."""
    start = there.now
    there.arms[ARM[scene]].set_fault(SignalFault(kind, start))
    while there.arm(ARM[scene]).violation is None and there.now < start + 0.5:
        there.advance(0.005)
    return there.now - start


@pytest.mark.parametrize("kind", CAUSES)
@pytest.mark.parametrize("scene", ARMS)
def test_an_arm_comes_to_rest_without_the_signals_of_its_joints(scene: str, kind: FaultKind) -> None:
    there = moving(scene)
    arm = there.arm(ARM[scene])
    assert np.abs(speeds(there, scene)).max() > 0.05
    assert falsified(there, scene, kind) < 0.05
    assert arm.violation is not None
    assert CAUSES[kind] in arm.violation
    before = there.data.qpos.copy()
    there.advance(0.5)
    assert np.abs(speeds(there, scene)).max() < 0.01
    assert np.abs(there.data.qpos - before).max() < 0.05
    assert arm.at_rest


@pytest.mark.parametrize("kind", WRENCH_CAUSES)
def test_an_arm_with_a_wrist_stops_when_its_wrench_is_wrong(kind: FaultKind) -> None:
    scene = "ur5e_whiteboard"
    there = moving(scene)
    assert falsified(there, scene, kind) < 0.05
    assert WRENCH_CAUSES[kind] in (there.arm(ARM[scene]).violation or "")
    there.advance(0.5)
    assert np.abs(speeds(there, scene)).max() < 0.01


@pytest.mark.parametrize("scene", ARMS)
def test_signals_that_are_right_stop_nothing(scene: str) -> None:
    there = moving(scene)
    there.advance(1.5)
    assert there.arm(ARM[scene]).violation is None
    assert there.arm(ARM[scene]).motion.done


@pytest.mark.parametrize("scene", ARMS)
def test_an_arm_moves_again_once_the_stop_is_acknowledged(scene: str) -> None:
    there = moving(scene)
    falsified(there, scene, "all-frozen")
    there.advance(0.5)
    there.arms[ARM[scene]].set_fault(None)
    there.stops.clear()
    there.advance(0.1)
    arm = there.arm(ARM[scene])
    assert arm.violation is None
    start = arm.motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, 0.0, 0.02]), start.rotation)
    arm.motion.move_along(path_through((start, goal), MotionLimits(0.1, 0.5)))
    there.advance(1.0)
    assert arm.motion.done
    assert np.linalg.norm(arm.measured.pose.position - goal.position) < 0.005


@pytest.mark.parametrize("scene", ARMS)
def test_a_fault_that_is_still_there_stops_the_arm_again(scene: str) -> None:
    there = moving(scene)
    falsified(there, scene, "speed-out-of-range")
    there.stops.clear()
    there.advance(0.05)
    assert "joint 2 is measured to move with 20.0 rad/s" in (there.arm(ARM[scene]).violation or "")
