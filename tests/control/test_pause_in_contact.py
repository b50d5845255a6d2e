"""A push in a pause: it is kept, or the tool is taken off, held, and brought back; bounded in force, speed and way."""

import numpy as np
import pytest
from rig import GAINS, Bench

from skillc_runtime.control.compliance_control import LIFT_M, RETARE_M
from skillc_runtime.devices.guarded_push import GuardedPush, Travel
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose

FORCE_N = {"iiwa14": 18.0, "ur5e": 8.0}
APPROACH_M_S = 0.05
LIMITS = MotionLimits(speed=0.08, acceleration=0.4)


class Pressing:
    """A bench whose tool pushes along its own axis, towards a plate or into the air."""

    def __init__(self, robot, gap=0.03, seconds=2.0, travel=0.1):
        self.bench = Bench(robot, gap=gap)
        self.driver, self.force_n = self.bench.driver, FORCE_N[robot]
        self.normal = -self.driver.measured.pose.rotation[:, 2]
        self.driver.compliance.release(self.normal)
        push = GuardedPush(self.normal, self.force_n, APPROACH_M_S, Travel(travel))
        self.push = self.driver.compliance.start_push(push)
        self.bench.run(seconds)

    @property
    def height(self):
        return float(self.driver.measured.pose.position @ self.normal)

    def run(self, seconds):
        """Forces along the normal and heights, (n,) each, of so many seconds."""
        began = len(self.bench.log["force"])
        self.bench.run(seconds)
        return np.array(self.bench.log["force"])[began:] @ self.normal, (
            np.array(self.bench.log["tool"])[began:] @ self.normal
        )

    def until_pressing(self, seconds=0.4, limit=5.0):
        """The same, until the tool has been in contact for so long."""
        forces, heights = [], []
        while (self.push.pressed_s or 0.0) < seconds:
            assert len(forces) * 0.01 < limit, "it does not come into contact"
            self.driver.compliance.resume()
            force, height = self.run(0.01)
            forces.append(force)
            heights.append(height)
        return np.concatenate(forces), np.concatenate(heights)

    def end(self):
        """End push and release, as their scopes do."""
        self.driver.compliance.end_push(self.push)
        self.driver.compliance.restore()


def speeds(heights):
    return np.diff(heights) / 0.001


def test_a_force_that_is_kept_stays_the_same(robot):
    arm = Pressing(robot)
    arm.driver.motion.pause()
    arm.driver.compliance.pause()
    force, heights = arm.run(1.0)
    assert arm.driver.motion.stationary and arm.driver.measured.still
    assert np.abs(force / arm.force_n - 1).max() < 0.02
    assert np.ptp(heights) < 1e-4
    arm.driver.compliance.resume()
    force, _ = arm.run(0.5)
    assert np.abs(force / arm.force_n - 1).max() < 0.02


@pytest.mark.slow
def test_a_tool_is_taken_off_held_and_brought_back(robot):
    arm = Pressing(robot)
    pressed_at = arm.height
    arm.driver.compliance.pause()
    arm.driver.compliance.withdraw(arm.push)
    force, heights = arm.run(1.5)
    assert arm.push.pressed_s is None
    assert force.max() <= 1.02 * arm.force_n and not force[-1000:].any()
    assert speeds(heights).max() < 2 * APPROACH_M_S
    assert heights[-1] - pressed_at == pytest.approx(LIFT_M, abs=1e-3)
    assert arm.driver.motion.stationary and arm.driver.measured.still
    force, heights = arm.run(1.0)
    assert not force.any() and np.ptp(heights) < 1e-5
    force, heights = arm.until_pressing()
    assert force.max() <= 1.1 * arm.force_n
    assert -speeds(heights).min() < 1.2 * APPROACH_M_S
    assert not force[heights > pressed_at + 0.015].any()
    assert abs(arm.run(1.0)[0][-1] / arm.force_n - 1) < 0.02


@pytest.mark.sim
def test_a_tool_that_was_taken_off_does_not_drift(robot):
    """Also where the weight of the tool is not known well: a pull of 5 N towards the plate all the time."""
    arm = Pressing(robot)
    arm.bench.data.xfrc_applied[arm.bench.model.body("eraser").id, :3] = -5.0 * arm.normal
    arm.driver.compliance.withdraw(arm.push)
    arm.run(2.0)
    force, heights = arm.run(20.0)
    assert not force.any()
    assert np.ptp(heights) < 1e-4


@pytest.mark.sim
def test_a_pause_beside_the_way_keeps_the_motion(robot):
    arm = Pressing(robot)
    start = arm.driver.motion.stopping_pose()
    goal = Pose(start.position + 0.1 * start.rotation[:, 0], start.rotation)
    arm.driver.motion.move_along(path_through([start, goal], LIMITS))
    arm.run(0.6)
    arm.driver.motion.pause()
    arm.driver.compliance.pause()
    arm.run(0.7)
    paused_at = arm.driver.measured.pose.position
    arm.driver.compliance.withdraw(arm.push)
    arm.run(1.5)
    beside = arm.driver.measured.pose.position - paused_at
    assert beside @ arm.normal == pytest.approx(LIFT_M, abs=1e-3)
    assert np.linalg.norm(beside - arm.normal * (arm.normal @ beside)) < 6e-3
    arm.until_pressing()
    arm.driver.motion.resume()
    forces = [arm.run(0.01)[0].mean() for _ in range(200)]
    assert arm.driver.motion.done
    across = arm.driver.measured.pose.position - goal.position
    assert np.linalg.norm(across - arm.normal * (arm.normal @ across)) < 6e-3
    assert np.abs(np.array(forces) / arm.force_n - 1).max() < 0.2


@pytest.mark.slow
def test_an_approach_is_stopped_and_goes_on(robot):
    arm = Pressing(robot, gap=0.06, seconds=0.6)
    assert arm.push.pressed_s is None
    arm.driver.compliance.pause()
    _, heights = arm.run(1.0)
    assert np.ptp(heights) < 0.01
    force, heights = arm.run(2.0)
    assert np.ptp(heights) < 1e-4 and not force.any()
    arm.driver.compliance.withdraw(arm.push)
    assert np.ptp(arm.run(0.5)[1]) < 1e-4
    arm.driver.compliance.resume()
    force, _ = arm.until_pressing(1.0)
    assert force.max() < 1.2 * arm.force_n and abs(force[-1] / arm.force_n - 1) < 0.02


def test_without_a_push_a_released_axis_is_held_and_yields_again():
    arm = Pressing("iiwa14", gap=None, seconds=0.0)
    arm.driver.compliance.end_push(arm.push)
    arm.run(0.5)
    body = arm.bench.model.body("eraser").id
    arm.driver.compliance.pause()
    arm.run(0.5)
    arm.bench.data.xfrc_applied[body, :3] = 6.0 * arm.normal
    _, heights = arm.run(2.0)
    assert np.ptp(heights) < 1.2 * 6.0 / GAINS["iiwa14"].linear_stiffness
    arm.driver.compliance.resume()
    assert arm.run(1.0)[1][-1] - heights[-1] > 0.03


def test_a_soft_axis_is_held_and_is_soft_again_at_its_place():
    bench = Bench("iiwa14")
    driver, x, body = bench.driver, np.array([0.0, 1.0, 0.0]), bench.model.body("eraser").id
    driver.compliance.release(x, 300.0)
    start = driver.measured.pose.position @ x
    bench.data.xfrc_applied[body, 1] = 6.0
    bench.run(1.5)
    driver.compliance.pause()
    bench.run(1.0)
    assert driver.measured.pose.position @ x - start == pytest.approx(6.0 / 300.0 + 6.0 / 1500.0, abs=1e-3)
    bench.data.xfrc_applied[body, 1] = 0.0
    bench.run(1.0)
    assert driver.measured.pose.position @ x - start > 0.01
    driver.compliance.resume()
    bench.run(3.0)
    assert abs(driver.measured.pose.position @ x - start) < 1e-3


@pytest.mark.sim
def test_a_tool_that_loses_contact_in_a_pause_is_held(robot):
    arm = Pressing(robot)
    pressed_at = arm.height
    arm.driver.compliance.pause()
    arm.bench.model.body("plate").pos -= 0.05 * arm.normal
    _, heights = arm.run(1.0)
    assert pressed_at - heights.min() < 0.02
    assert np.ptp(arm.run(2.0)[1]) < 1e-4 and arm.driver.fault is None
    arm.driver.compliance.resume()
    arm.run(2.5)
    assert arm.push.pressed_s is not None and arm.height < pressed_at - 0.03


@pytest.mark.sim
@pytest.mark.parametrize(
    ("robot", "phase"),
    [("iiwa14", "kept"), ("ur5e", "withdrawn"), ("iiwa14", "taken off"), ("ur5e", "approaching")],
)
def test_ending_in_a_pause_leaves_the_arm_stiff_and_at_rest(robot, phase):
    arm = Pressing(robot)
    start = arm.driver.motion.stopping_pose()
    goal = Pose(start.position + 0.1 * start.rotation[:, 0], start.rotation)
    arm.driver.motion.move_along(path_through([start, goal], LIMITS))
    arm.run(0.5)
    arm.driver.motion.pause()
    arm.driver.compliance.pause()
    arm.run(0.7)
    if phase != "kept":
        arm.driver.compliance.withdraw(arm.push)
        arm.run(0.2 if phase == "taken off" else 1.5)
    if phase == "approaching":
        arm.driver.compliance.resume()
        arm.run(0.2)
    arm.driver.motion.stop()
    arm.end()
    arm.run(2.0)
    assert arm.driver.at_rest
    _, heights = arm.run(1.0)
    assert np.ptp(heights) < 1e-5
    gains = GAINS[robot]
    stiff = np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3)
    assert np.array_equal(arm.driver.compliance.commanded_stiffness, stiff)
    assert arm.driver.motion.tracking_error_message is None
    arm.driver.compliance.release(arm.normal)
    again = arm.driver.compliance.start_push(arm.push.push)
    arm.run(2.5)
    assert again.pressed_s is not None


@pytest.mark.sim
@pytest.mark.parametrize(("robot", "phase"), [("iiwa14", "approaching"), ("ur5e", "pressing")])
def test_an_arm_that_has_stopped_by_itself_is_held_until_it_pushes_again(robot, phase):
    arm = Pressing(robot, gap=0.06, seconds=0.6 if phase == "approaching" else 2.5)
    arm.driver.abort("a fault")
    arm.run(1.0)
    arm.bench.data.xfrc_applied[arm.bench.model.body("eraser").id, :3] = -5.0 * arm.normal
    arm.run(0.5)
    force, heights = arm.run(2.0)
    assert force.max() < 5.0 + 0.2 * arm.force_n and np.ptp(heights) < 1e-4
    arm.bench.data.xfrc_applied[:] = 0.0
    again = arm.driver.compliance.start_push(arm.push.push)
    force, heights = arm.run(2.5)
    assert again.pressed_s is not None and abs(force[-1] / arm.force_n - 1) < 0.02


def test_a_tool_is_taken_off_tared_and_pressed_on_again():
    """It rests above the surface in between, and comes back to where it was without hitting it."""
    pressing = Pressing("ur5e")
    pressing.bench.mean_wrench = np.zeros(6)
    pressed_at, forces, heights = pressing.height, [], []
    while not pressing.driver.compliance.retare():
        assert len(forces) < 500, "it does not press again"
        force, height = pressing.run(0.01)
        forces.append(force)
        heights.append(height)
    forces, heights = np.concatenate(forces), np.concatenate(heights)
    assert heights.max() - pressed_at == pytest.approx(RETARE_M, abs=0.003)
    free = forces < 0.1
    assert np.abs(speeds(heights[free][-900:-300])).max() < 0.002
    assert forces.max() < 2 * pressing.force_n
    assert pressing.run(0.2)[0].mean() == pytest.approx(pressing.force_n, rel=0.05)
    pressing.end()


def test_nothing_is_taken_off_if_nothing_can_be_tared():
    pressing = Pressing("ur5e")
    at = pressing.height
    assert pressing.driver.compliance.retare()
    pressing.run(0.1)
    assert pressing.height == pytest.approx(at, abs=1e-4)
