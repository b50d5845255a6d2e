"""The arm driver in simulation: forces as commanded, no jumps, alike at every rate, in any frame."""

import numpy as np
import pytest
from rig import GAINS, HOMES, Bench, moved_by

from skillc_runtime.motion.overlays import Circle
from skillc_runtime.motion.path import path
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.motion.segments import MotionLimits
from skillc_runtime.robots.arm import Torque

LIMITS = MotionLimits(speed=0.1, acceleration=0.4)
FORCE_N = {"iiwa14": 18.0, "ur5e": 8.0}


def out_of(bench):
    """The direction out of the plate, from the tool's point of view."""
    return -bench.driver.pose.rotation[:, 2]


def pushing(robot, **options):
    """A bench whose tool presses on the plate, and the direction out of it."""
    bench = Bench(robot, gap=0.01, **options)
    normal = out_of(bench)
    bench.driver.release(normal)
    bench.driver.push(normal, 0.04 * bench.driver.gains.release_damping)
    bench.run(0.8)
    bench.driver.push(normal, FORCE_N[robot])
    bench.run(1.2)
    return bench, normal


def forces(bench, normal):
    return np.array(bench.log["force"]) @ normal


def test_a_line_ends_where_it_shall_without_overshoot(robot):
    bench = Bench(robot)
    driver = bench.driver
    start = driver.anchor
    goal = moved_by(start, 0.08, 0.1, -0.05, turn=(0.0, 0.1, 0.3))
    driver.move_along(path([start, goal], LIMITS))
    assert not driver.done
    bench.until_done()
    bench.run(0.3)
    assert driver.behind is None
    assert np.abs(driver.pose.position - goal.position).max() < 1e-4
    assert np.abs(driver.pose.rotation - goal.rotation).max() < 1e-3
    way = (np.array(bench.log["tool"]) - start.position) @ (goal.position - start.position)
    assert way.max() <= np.linalg.norm(goal.position - start.position) ** 2 * 1.005


def test_the_tool_follows_closely_on_the_way(robot):
    bench = Bench(robot)
    driver, worst = bench.driver, 0.0

    def measure():
        nonlocal worst
        worst = max(worst, float(np.abs(driver.pose.position - driver.reference.pose.position).max()))

    start = driver.anchor
    driver.move_along(path([start, moved_by(start, 0.0, 0.2, 0.0)], LIMITS))
    bench.run(1.5, measure)
    assert 1e-6 < worst < 0.004


def test_joints_go_where_they_shall_and_both_modes_join_without_a_jump(robot):
    bench = Bench(robot)
    driver = bench.driver
    goal = np.array(HOMES[robot]) + 0.2
    driver.move_joints(goal, 0.3)
    bench.run(0.4)
    driver.hold_position()
    bench.until_done(2.0)
    driver.move_joints(goal, 0.3)
    bench.until_done()
    bench.run(0.3)
    assert driver.at_joints(goal)
    assert driver.behind is None
    steps = np.abs(np.diff(np.array(bench.log["torque"]), axis=0)).max()
    assert steps < (2.0 if robot == "iiwa14" else 0.002)  # N m at most 1 by rate and some bias; rad at 2 rad/s
    speed = np.abs(np.diff(np.array(bench.log["tool"]), axis=0)).max() / 0.001
    assert speed < 1.0


def test_a_motion_that_is_given_up_comes_to_rest_smoothly_and_the_next_goes_on_from_there(robot):
    bench = Bench(robot)
    driver, references = bench.driver, []
    start = driver.anchor
    driver.move_along(path([start, moved_by(start, 0.0, 0.2, 0.0)], LIMITS))
    note = lambda: references.append(driver.reference.twist)  # noqa: E731
    bench.run(0.8, note)
    driver.stop()
    bench.run(0.05, note)
    anchor = driver.anchor
    driver.move_along(path([anchor, moved_by(anchor, 0.05, 0.0, 0.0)], LIMITS))
    bench.run(2.0, note)
    assert driver.done
    assert np.abs(driver.pose.position - moved_by(anchor, 0.05, 0.0, 0.0).position).max() < 1e-3
    assert np.abs(np.diff(np.array(references), axis=0)[:, :3]).max() < 0.001 * (0.5 + 0.4) + 1e-9


def test_a_motion_must_start_where_the_last_one_ends(robot):
    driver = Bench(robot).driver
    start = driver.anchor
    with pytest.raises(ValueError, match=r"starts 50\.0 mm beside"):
        driver.move_along(path([moved_by(start, 0.05, 0, 0), start], LIMITS))


@pytest.mark.sim
def test_a_pause_stands_still_on_the_way_and_goes_on(robot):
    bench = Bench(robot)
    driver = bench.driver
    start = driver.anchor
    goal = moved_by(start, 0.0, 0.15, 0.0)
    driver.move_along(path([start, goal], LIMITS))
    bench.run(0.8)
    driver.pause()
    bench.run(1.0)
    here = driver.pose.position
    bench.run(1.0)
    assert np.abs(driver.pose.position - here).max() < 1e-3
    assert not driver.done
    driver.resume()
    bench.until_done()
    bench.run(0.3)
    assert np.abs(driver.pose.position - goal.position).max() < 1e-3


def test_springs_have_their_stiffness():
    bench = Bench("iiwa14")
    bench.run(0.1)
    driver = bench.driver
    start = driver.anchor
    body = bench.model.body("eraser").id
    bench.data.xfrc_applied[body] = [6.0, -9.0, 3.0, 0.0, 0.0, 0.0]
    bench.data.xfrc_applied[body, 3:] = np.cross(start.position - bench.data.xipos[body], [6.0, -9.0, 3.0])
    bench.run(3.0)
    assert np.allclose(driver.pose.position - start.position, np.array([6.0, -9.0, 3.0]) / 1500, rtol=0.03, atol=1e-5)
    assert np.allclose(driver.wrench[:3], [6.0, -9.0, 3.0], rtol=0.03)


def test_a_released_tool_stays_until_it_is_pushed_and_then_moves_with_the_stated_damping(robot):
    bench = Bench(robot)
    driver = bench.driver
    normal, start = out_of(bench), driver.pose.position
    driver.release(normal)
    bench.run(1.0)
    assert np.abs(driver.pose.position - start).max() < 1e-4
    driver.push(normal, 0.05 * driver.gains.release_damping)
    bench.run(0.6)
    assert 0.03 < -driver.velocity[:3] @ normal < 0.055
    driver.push_off()
    bench.run(0.8)
    assert abs(driver.velocity[:3] @ normal) < 1e-3
    across = driver.pose.position - start
    assert np.linalg.norm(across - normal * (normal @ across)) < 1e-3


def test_it_presses_as_hard_as_it_shall(robot):
    bench, normal = pushing(robot)
    force = forces(bench, normal)
    assert force[-200:].mean() == pytest.approx(FORCE_N[robot], rel=0.02)
    assert force.max() < 2 * FORCE_N[robot]
    assert bench.driver.wrench[:3] @ normal == pytest.approx(FORCE_N[robot], rel=0.03)


@pytest.mark.sim
def test_it_presses_as_hard_while_wiping_with_a_circle(robot):
    bench, normal = pushing(robot)
    driver = bench.driver
    start = driver.anchor
    x = start.rotation[:, 0]
    handle = driver.add_overlay(Circle(0.015, 1.0), np.column_stack([x, np.cross(normal, x), normal]), 0.5)
    driver.move_along(path([start, Pose(start.position + 0.1 * x, start.rotation)], LIMITS))
    began = len(bench.log["force"])
    bench.run(3.0)
    assert driver.done
    driver.remove_overlay(handle)
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
    before = driver.pose.position
    began = len(bench.log["torque"])
    driver.push_off()
    driver.restore()
    bench.run(1.0)
    force = forces(bench, normal)[began:]
    assert force.max() <= FORCE_N[robot] * 1.02
    assert np.abs(np.diff(force)).max() < 0.5
    assert abs((driver.pose.position - before) @ normal) < 0.02
    start = driver.anchor
    driver.move_along(path([start, Pose(start.position + 0.05 * normal, start.rotation)], LIMITS))
    bench.until_done()
    bench.run(0.3)
    assert driver.behind is None
    assert forces(bench, normal)[-1] == 0.0


def test_restoring_a_soft_axis_keeps_its_force_at_first():
    bench = Bench("iiwa14")
    driver = bench.driver
    x = np.array([0.0, 1.0, 0.0])
    driver.release(x, 300.0)
    bench.run(1.0)
    bench.data.xfrc_applied[bench.model.body("eraser").id, 1] = 6.0
    bench.run(1.5)
    began = len(bench.log["torque"])
    driver.restore()
    bench.run(0.5)
    assert np.abs(np.diff(np.array(bench.log["torque"])[began - 2 :], axis=0)).max() < 0.2
    assert 0.01 < driver.pose.position[1] - Bench("iiwa14").driver.pose.position[1] < 0.03


@pytest.mark.sim
def test_a_tilted_plate_turns_the_tool_flush(robot):
    bench, normal = pushing(robot, tilt=(0.04, -0.03, 0.0))
    driver = bench.driver
    true = bench.data.xmat[bench.model.body("plate").id].reshape(3, 3)[:, 2]
    driver.release_rotation()
    bench.run(3.0)
    driver.restore_rotation()
    bench.run(0.3)
    tilt = np.degrees(np.arccos(min(1.0, float(true @ -driver.pose.rotation[:, 2]))))
    assert tilt < 0.5
    assert np.degrees(np.arccos(true @ normal)) > 2.0
    assert forces(bench, true)[-100:].mean() == pytest.approx(FORCE_N[robot], rel=0.02)


def test_the_push_has_limits_and_needs_a_released_axis(robot):
    bench = Bench(robot)
    driver, normal = bench.driver, out_of(bench)
    with pytest.raises(ValueError, match="does not yield"):
        driver.push(normal, 5.0)
    driver.release(normal)
    assert driver.yields_along(-normal)
    with pytest.raises(ValueError, match="beyond the 50 N"):
        driver.push(normal, 51.0)
    with pytest.raises(ValueError, match="parallel or at right angles"):
        driver.release(exp(np.array([0.3, 0.3, 0.0])) @ normal)


def test_in_the_world_everything_is_the_same_wherever_the_arm_stands(robot):
    turned = Pose(np.array([2.0, -1.0, 0.5]), exp(np.array([0.0, 0.0, 2.0])))
    tools = []
    for base in (Pose.of((0, 0, 0)), turned):
        bench = Bench(robot, base=base)
        driver = bench.driver
        start = driver.anchor
        driver.move_along(
            path([start, Pose(start.position + base.rotation @ [0.05, 0.1, -0.05], start.rotation)], LIMITS)
        )
        bench.run(1.0)
        back = base.inverse()
        tools.append([back.at(driver.pose.position), back.at(driver.reference.pose.position)])
        tools[-1].append(base.rotation.T @ driver.velocity[:3])
    assert np.allclose(tools[0], tools[1], atol=1e-6)


def test_an_arm_on_a_driving_base_keeps_its_posture(robot):
    bench = Bench(robot)
    bench.run(0.1)
    q = bench.driver.q
    bench.base = Pose(np.array([1.0, 0.0, 0.0]), np.eye(3))
    bench.driver._base = lambda: bench.base
    bench.run(0.0)
    assert bench.driver.at_joints(q)
    assert bench.driver.done


def test_taking_hold_of_a_tool_moves_nothing(robot):
    bench = Bench(robot)
    driver = bench.driver
    driver.hold_position()
    bench.run(0.2)
    q, tool = driver.q, bench.driver.pose
    bench.model.site_pos[bench.model.site("tip").id, 2] += 0.08
    bench.run(0.5)
    assert np.abs(driver.q - q).max() < 1e-4
    assert np.linalg.norm(driver.pose.position - tool.position) == pytest.approx(0.08, abs=1e-4)
    assert np.abs(driver.reference.pose.position - driver.pose.position).max() < 1e-4


def test_a_motion_asked_for_right_after_taking_hold_is_made_with_the_tool(robot):
    bench = Bench(robot)
    driver = bench.driver
    driver.hold_position()
    bench.run(0.1)
    bench.model.site_pos[bench.model.site("tip").id, 2] += 0.08
    bench.state_at_rest()
    start = driver.anchor
    goal = moved_by(start, 0.0, 0.0, 0.05)
    driver.move_along(path([start, goal], LIMITS))
    bench.until_done()
    bench.run(0.3)
    assert np.linalg.norm(start.position - bench.log["tool"][0]) == pytest.approx(0.08, abs=1e-3)
    assert np.abs(driver.pose.position - goal.position).max() < 1e-3


def test_a_blocked_arm_is_noticed_and_can_go_on():
    bench = Bench("ur5e")
    driver = bench.driver
    bench.run(0.01)
    bench.model.actuator_gainprm[:] = 0.0
    bench.model.actuator_biasprm[:] = 0.0
    driver.move_joints(np.array(HOMES["ur5e"]) + 1.0, 1.0)
    bench.run(1.5)
    assert "blocked" in driver.fault


@pytest.mark.sim
def test_torques_never_change_faster_than_stated():
    bench, _ = pushing("iiwa14")
    bench.driver.restore()
    bench.driver.move_joints(np.array(HOMES["iiwa14"]), 1.0)
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
    driver.push_off()
    assert not driver.at_rest
    driver.restore()
    bench.run(1.5)
    assert driver.at_rest
    start = driver.anchor
    driver.move_along(path([start, Pose(start.position + 0.02 * normal, start.rotation)], LIMITS))
    bench.run(0.1)
    assert not driver.at_rest
    bench.until_done()
    bench.run(0.5)
    assert driver.at_rest
    handle = driver.add_overlay(Circle(0.01, 1.0), np.eye(3), 0.2)
    bench.run(0.1)
    assert not driver.at_rest
    driver.remove_overlay(handle)
    bench.run(1.0)
    assert driver.at_rest
