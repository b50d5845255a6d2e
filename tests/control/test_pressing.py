"""The arm driver in simulation yields and presses: stiffness and forces as commanded, no jumps, alike at every rate."""

import numpy as np
import pytest
from rig import GAINS, HOMES, Bench

from skillc_runtime.devices.arm import Torque
from skillc_runtime.motion.overlays import Circle
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose, exp

LIMITS = MotionLimits(speed=0.1, acceleration=0.4)
FORCE_N = {"iiwa14": 18.0, "ur5e": 8.0}


def out_of(bench):
    """The direction out of the plate, from the tool's point of view."""
    return -bench.driver.measured.pose.rotation[:, 2]


def pushing(robot, **options):
    """A bench whose tool presses on the plate, and the direction out of it."""
    bench = Bench(robot, gap=0.01, **options)
    normal = out_of(bench)
    bench.driver.compliance.release(normal)
    bench.driver.compliance.push(normal, 0.04 * GAINS[bench.robot].law.release_damping)
    bench.run(0.8)
    bench.driver.compliance.push(normal, FORCE_N[robot])
    bench.run(1.2)
    return bench, normal


def forces(bench, normal):
    return np.array(bench.log["force"]) @ normal


def test_springs_have_their_stiffness():
    bench = Bench("iiwa14")
    bench.run(0.1)
    driver = bench.driver
    start = driver.motion.stopping_pose()
    body = bench.model.body("eraser").id
    bench.data.xfrc_applied[body] = [6.0, -9.0, 3.0, 0.0, 0.0, 0.0]
    bench.data.xfrc_applied[body, 3:] = np.cross(start.position - bench.data.xipos[body], [6.0, -9.0, 3.0])
    bench.run(3.0)
    assert np.allclose(
        driver.measured.pose.position - start.position, np.array([6.0, -9.0, 3.0]) / 1500, rtol=0.03, atol=1e-5
    )
    assert np.allclose(driver.measured.wrench[:3], [6.0, -9.0, 3.0], rtol=0.03)


def test_a_released_tool_stays_until_it_is_pushed_and_then_moves_with_the_stated_damping(robot):
    bench = Bench(robot)
    driver = bench.driver
    normal, start = out_of(bench), driver.measured.pose.position
    driver.compliance.release(normal)
    bench.run(1.0)
    assert np.abs(driver.measured.pose.position - start).max() < 1e-4
    driver.compliance.push(normal, 0.05 * GAINS[bench.robot].law.release_damping)
    bench.run(0.6)
    assert 0.03 < -driver.measured.velocity[:3] @ normal < 0.055
    driver.compliance.push_off()
    bench.run(0.8)
    assert abs(driver.measured.velocity[:3] @ normal) < 1e-3
    across = driver.measured.pose.position - start
    assert np.linalg.norm(across - normal * (normal @ across)) < 1e-3


def test_it_presses_as_hard_as_it_shall(robot):
    bench, normal = pushing(robot)
    force = forces(bench, normal)
    assert force[-200:].mean() == pytest.approx(FORCE_N[robot], rel=0.02)
    assert force.max() < 2 * FORCE_N[robot]
    measured = bench.driver.measured
    assert measured.wrench[:3] @ normal == pytest.approx(FORCE_N[robot], rel=0.03)
    assert measured.pressing_n == pytest.approx(-measured.wrench[:3] @ measured.pose.rotation[:, 2], rel=1e-12)
    assert measured.pressing_n > 0.95 * FORCE_N[robot]


@pytest.mark.sim
def test_it_presses_as_hard_while_wiping_with_a_circle(robot):
    bench, normal = pushing(robot)
    driver = bench.driver
    start = driver.motion.stopping_pose()
    x = start.rotation[:, 0]
    handle = driver.motion.add_overlay(Circle(0.015, 1.0), np.column_stack([x, np.cross(normal, x), normal]), 0.5)
    driver.motion.move_along(path_through([start, Pose(start.position + 0.1 * x, start.rotation)], LIMITS))
    began = len(bench.log["force"])
    bench.run(3.0)
    assert driver.motion.done
    driver.motion.remove_overlay(handle)
    force = forces(bench, normal)[began:]
    assert force.mean() == pytest.approx(FORCE_N[robot], rel=0.03)
    assert force.min() > 0.3 * FORCE_N[robot]
    assert np.sqrt(np.mean((force / FORCE_N[robot] - 1) ** 2)) < 0.15


@pytest.mark.sim
def test_it_presses_alike_at_every_rate(robot):
    results = []
    for period in (0.001, 0.002, 0.004):
        bench, normal = pushing(robot, period=period)
        force, tool = forces(bench, normal), np.array(bench.log["tool"])
        count = round(0.2 / period)
        results.append((force[-count:].mean(), tool[-1] @ normal))
    mean, height = np.array(results).T
    assert np.allclose(mean, FORCE_N[robot], rtol=0.02)
    assert np.ptp(height) < 5e-4


@pytest.mark.sim
def test_restoring_holds_the_tool_where_it_is_without_a_jump(robot):
    bench, normal = pushing(robot)
    driver = bench.driver
    before = driver.measured.pose.position
    began = len(bench.log["torque"])
    driver.compliance.push_off()
    driver.compliance.restore()
    bench.run(1.0)
    force = forces(bench, normal)[began:]
    assert force.max() <= FORCE_N[robot] * 1.02
    assert np.abs(np.diff(force)).max() < 0.5
    assert abs((driver.measured.pose.position - before) @ normal) < 0.02
    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, Pose(start.position + 0.05 * normal, start.rotation)], LIMITS))
    bench.until_done()
    bench.run(0.3)
    assert driver.motion.tracking_error_message is None
    assert forces(bench, normal)[-1] == 0.0


def test_restoring_a_soft_axis_keeps_its_force_at_first():
    bench = Bench("iiwa14")
    driver = bench.driver
    x = np.array([0.0, 1.0, 0.0])
    driver.compliance.release(x, 300.0)
    bench.run(1.0)
    bench.data.xfrc_applied[bench.model.body("eraser").id, 1] = 6.0
    bench.run(1.5)
    began = len(bench.log["torque"])
    driver.compliance.restore()
    bench.run(0.5)
    assert np.abs(np.diff(np.array(bench.log["torque"])[began - 2 :], axis=0)).max() < 0.2
    assert 0.01 < driver.measured.pose.position[1] - Bench("iiwa14").driver.measured.pose.position[1] < 0.03


@pytest.mark.sim
def test_a_tilted_plate_turns_the_tool_flush(robot):
    bench, normal = pushing(robot, tilt=(0.04, -0.03, 0.0))
    driver = bench.driver
    true = bench.data.xmat[bench.model.body("plate").id].reshape(3, 3)[:, 2]
    driver.compliance.release_rotation()
    bench.run(3.0)
    driver.compliance.restore_rotation()
    bench.run(0.3)
    tilt = np.degrees(np.arccos(min(1.0, float(true @ -driver.measured.pose.rotation[:, 2]))))
    assert tilt < 0.5
    assert np.degrees(np.arccos(true @ normal)) > 2.0
    assert forces(bench, true)[-100:].mean() == pytest.approx(FORCE_N[robot], rel=0.02)


def test_the_push_has_limits_and_needs_a_released_axis(robot):
    bench = Bench(robot)
    driver, normal = bench.driver, out_of(bench)
    with pytest.raises(ValueError, match="does not yield"):
        driver.compliance.push(normal, 5.0)
    driver.compliance.release(normal)
    assert driver.compliance.yields_along(-normal)
    with pytest.raises(ValueError, match="beyond the 50 N"):
        driver.compliance.push(normal, 51.0)
    with pytest.raises(ValueError, match="parallel or at right angles"):
        driver.compliance.release(exp(np.array([0.3, 0.3, 0.0])) @ normal)


@pytest.mark.sim
def test_torques_never_change_faster_than_stated():
    bench, _ = pushing("iiwa14")
    bench.driver.compliance.restore()
    bench.driver.motion.move_joints(np.array(HOMES["iiwa14"]), 1.0)
    changes, biases = [], []
    command = bench.command

    def noting(told):
        assert isinstance(told, Torque)
        changes.append(told.tau - bench.data.qfrc_bias)
        biases.append(bench.data.qfrc_bias.copy())
        command(told)

    bench.command = noting
    bench.run(1.0)
    assert len(changes) == 1000
    assert np.abs(np.diff(changes, axis=0)).max() <= GAINS["iiwa14"].law.torque_rate * 0.001 + 1e-9


def test_an_arm_is_at_rest_once_it_neither_moves_nor_pushes(robot):
    bench, normal = pushing(robot)
    driver = bench.driver
    assert not driver.at_rest
    driver.compliance.push_off()
    assert not driver.at_rest
    driver.compliance.restore()
    bench.run(1.5)
    assert driver.at_rest
    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, Pose(start.position + 0.02 * normal, start.rotation)], LIMITS))
    bench.run(0.1)
    assert not driver.at_rest
    bench.until_done()
    bench.run(0.5)
    assert driver.at_rest
    handle = driver.motion.add_overlay(Circle(0.01, 1.0), np.eye(3), 0.2)
    bench.run(0.1)
    assert not driver.at_rest
    driver.motion.remove_overlay(handle)
    bench.run(1.0)
    assert driver.at_rest
