"""An arm that takes speeds: nothing jumps, drifts or depends on the rate, even where the arm's own speeds are wrong."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from backends.backend import ModelBackend, mujoco
from skillc_runtime.control.controller import ControlError
from skillc_runtime.devices.arm import Command, JointVelocity
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Array, Pose

LIMITS = MotionLimits(speed=0.2, acceleration=0.5)


def arm_told_speeds(steps_per_command: int = 1) -> ModelBackend:
    made = mujoco("ur5e_whiteboard", "forward_dynamics_velocity", steps_per_command)
    made.driver.motion.hold_position()
    made.advance(0.02)
    return made


def told(there: ModelBackend, changed: Callable[[Array], Array] = np.copy) -> list[Array]:
    """The growing list of the speeds that the arm is told; it moves with what `changed` makes of them."""
    speeds: list[Array] = []
    command = there.arm.command

    def note(each: Command) -> None:
        assert isinstance(each, JointVelocity)
        speeds.append(each.dq.copy())
        command(JointVelocity(changed(each.dq)))

    there.arm.command = note  # type: ignore[method-assign]
    there.call_in_python()
    return speeds


def beside(there: ModelBackend, *way: float) -> Pose:
    return Pose(
        there.driver.motion.stopping_pose().position + np.array(way), there.driver.motion.stopping_pose().rotation
    )


def test_whatever_is_changed_on_the_way_no_speed_jumps() -> None:
    there = arm_told_speeds()
    driver, home, speeds = there.driver, there.driver.measured.q, told(there)
    driver.motion.move_along(path_through([driver.motion.stopping_pose(), beside(there, 0.0, 0.08, 0.0)], LIMITS))
    there.advance(0.3)
    driver.motion.move_joints(home + 0.1, 0.2)
    there.advance(0.2)
    driver.motion.hold_position()
    there.advance(0.1)
    driver.compliance.release(driver.measured.pose.rotation[:, 2])
    driver.compliance.push(driver.measured.pose.rotation[:, 2], 5.0)
    there.advance(0.1)
    driver.compliance.restore()
    there.advance(0.1)
    driver.motion.move_joints(home, 0.2)
    there.advance(0.2)
    assert len(speeds) == 1000
    assert np.abs(speeds).max() > 0.05
    assert np.abs(np.diff(speeds, axis=0)).max() < 0.02, "rad/s from one period to the next"


def wrong(dq: Array) -> Array:
    return 1.05 * dq + 0.01


def test_an_arm_whose_speeds_are_wrong_does_not_drift() -> None:
    there = arm_told_speeds()
    start, moved = there.driver.measured.q, told(there, wrong)
    there.driver.motion.move_joints(start, 0.5)
    there.advance(1.0)
    after_one = there.driver.measured.q
    there.advance(1.0)
    assert np.abs(there.driver.measured.q - after_one).max() < 2e-5
    assert np.abs(after_one - start).max() < 1.1 * 0.01 / 5.0, "the wrong speed over the tracking rate"
    assert np.abs(moved[-1] + 0.01).max() < 1e-3


def test_an_arm_whose_speeds_are_wrong_gets_to_its_goals() -> None:
    there = arm_told_speeds()
    told(there, lambda dq: 1.05 * dq)
    goal = there.driver.measured.q - 0.3
    there.driver.motion.move_joints(goal, 0.3)
    there.advance(2.0)
    assert there.driver.motion.done
    assert np.abs(there.driver.measured.q - goal).max() < 2e-3


def test_what_is_no_number_makes_it_hold_and_not_drift() -> None:
    there = arm_told_speeds()
    driver, state = there.driver, there.arm.state
    driver.motion.move_along(path_through([driver.motion.stopping_pose(), beside(there, 0.0, 0.08, 0.0)], LIMITS))
    there.advance(0.3)
    speeds, joints = told(there), there.arm._q
    good, joints[:] = joints.copy(), np.nan
    with pytest.raises(ControlError, match="not a number"):
        there.advance(0.001)
    joints[:] = good
    assert len(speeds) == 1
    assert not speeds[0].any()
    there.neglect()
    there.advance(0.2)
    stopped = state().q.copy()
    there.advance(1.0)
    assert np.abs(state().q - stopped).max() < 1e-4


def test_an_arm_that_is_blocked_is_stopped_and_stops_pressing() -> None:
    there = arm_told_speeds()
    there.driver.motion.move_joints(there.driver.measured.q + np.array([0.5, 0, 0, 0, 0, 0]), 0.3)
    there.advance(0.3)
    driver, joints = there.driver, there.arm._q
    blocked = joints.copy()
    for _ in range(1000):
        joints[:], there.arm._dq[:] = blocked, 0.0
        there.advance(0.001)
        if driver.fault is not None:
            break
    assert driver.fault is not None
    assert "something is in the way of a link" in driver.fault
    there.advance(0.5)
    assert np.abs(there.arm.state().q - blocked).max() < 5e-3


def test_a_line_is_followed_alike_at_every_rate() -> None:
    places = []
    for steps in (1, 2, 4):
        there, place = arm_told_speeds(steps), []
        there.driver.motion.move_along(
            path_through([there.driver.motion.stopping_pose(), beside(there, 0.0, 0.05, 0.03)], LIMITS)
        )
        for _ in range(8):
            there.advance(0.1)
            place.append(there.driver.measured.pose.position)
        places.append(place)
    assert np.ptp(places[0], axis=0).max() > 0.04
    for other, period in ((places[1], 0.002), (places[2], 0.004)):
        assert np.abs(np.subtract(other, places[0])).max() < LIMITS.speed * period
