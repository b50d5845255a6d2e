"""The arm driver in simulation moves tools and joints: where it shall, without jumps, in any frame."""

import numpy as np
import pytest
from rig import HOMES, Bench, moved_by

from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose, exp

LIMITS = MotionLimits(speed=0.1, acceleration=0.4)


def test_a_line_ends_where_it_shall_without_overshoot(robot):
    bench = Bench(robot)
    driver = bench.driver
    start = driver.motion.stopping_pose()
    goal = moved_by(start, 0.08, 0.1, -0.05, turn=(0.0, 0.1, 0.3))
    driver.motion.move_along(path_through([start, goal], LIMITS))
    assert not driver.motion.done
    bench.until_done()
    bench.run(0.3)
    assert driver.motion.tracking_error_message is None
    assert np.abs(driver.measured.pose.position - goal.position).max() < 1e-4
    assert np.abs(driver.measured.pose.rotation - goal.rotation).max() < 1e-3
    way = (np.array(bench.log["tool"]) - start.position) @ (goal.position - start.position)
    assert way.max() <= np.linalg.norm(goal.position - start.position) ** 2 * 1.005


def test_the_tool_follows_closely_on_the_way(robot):
    bench = Bench(robot)
    driver, worst = bench.driver, 0.0

    def measure():
        nonlocal worst
        worst = max(worst, float(np.abs(driver.measured.pose.position - driver.motion.reference.pose.position).max()))

    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, moved_by(start, 0.0, 0.2, 0.0)], LIMITS))
    bench.run(1.5, measure)
    assert 1e-6 < worst < 0.004


def test_joints_go_where_they_shall_and_both_modes_join_without_a_jump(robot):
    bench = Bench(robot)
    driver = bench.driver
    goal = np.array(HOMES[robot]) + 0.2
    driver.motion.move_joints(goal, 0.3)
    bench.run(0.4)
    driver.motion.hold_position()
    bench.until_done(2.0)
    driver.motion.move_joints(goal, 0.3)
    bench.until_done()
    bench.run(0.3)
    assert driver.measured.at_joints(goal)
    assert driver.motion.tracking_error_message is None
    steps = np.abs(np.diff(np.array(bench.log["torque"]), axis=0)).max()
    assert steps < (2.0 if robot == "iiwa14" else 0.002)  # N m at most 1 by rate and some bias; rad at 2 rad/s
    speed = np.abs(np.diff(np.array(bench.log["tool"]), axis=0)).max() / 0.001
    assert speed < 1.0


def test_a_motion_that_is_given_up_comes_to_rest_smoothly_and_the_next_goes_on_from_there(robot):
    bench = Bench(robot)
    driver, references = bench.driver, []
    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, moved_by(start, 0.0, 0.2, 0.0)], LIMITS))
    note = lambda: references.append(driver.motion.reference.twist)  # noqa: E731
    bench.run(0.8, note)
    driver.motion.stop()
    bench.run(0.05, note)
    anchor = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([anchor, moved_by(anchor, 0.05, 0.0, 0.0)], LIMITS))
    bench.run(2.0, note)
    assert driver.motion.done
    assert np.abs(driver.measured.pose.position - moved_by(anchor, 0.05, 0.0, 0.0).position).max() < 1e-3
    assert np.abs(np.diff(np.array(references), axis=0)[:, :3]).max() < 0.001 * (0.5 + 0.4) + 1e-9


def test_a_motion_must_start_where_the_last_one_ends(robot):
    driver = Bench(robot).driver
    start = driver.motion.stopping_pose()
    with pytest.raises(ValueError, match=r"starts 50\.0 mm beside"):
        driver.motion.move_along(path_through([moved_by(start, 0.05, 0, 0), start], LIMITS))


@pytest.mark.sim
def test_a_pause_stands_still_on_the_way_and_goes_on(robot):
    bench = Bench(robot)
    driver = bench.driver
    start = driver.motion.stopping_pose()
    goal = moved_by(start, 0.0, 0.15, 0.0)
    driver.motion.move_along(path_through([start, goal], LIMITS))
    bench.run(0.8)
    driver.motion.pause()
    bench.run(1.0)
    here = driver.measured.pose.position
    bench.run(1.0)
    assert np.abs(driver.measured.pose.position - here).max() < 1e-3
    assert not driver.motion.done
    driver.motion.resume()
    bench.until_done()
    bench.run(0.3)
    assert np.abs(driver.measured.pose.position - goal.position).max() < 1e-3


def test_in_the_world_everything_is_the_same_wherever_the_arm_stands(robot):
    turned = Pose(np.array([2.0, -1.0, 0.5]), exp(np.array([0.0, 0.0, 2.0])))
    tools = []
    for base in (Pose.of((0, 0, 0)), turned):
        bench = Bench(robot, base=base)
        driver = bench.driver
        start = driver.motion.stopping_pose()
        driver.motion.move_along(
            path_through([start, Pose(start.position + base.rotation @ [0.05, 0.1, -0.05], start.rotation)], LIMITS)
        )
        bench.run(1.0)
        back = base.inverse()
        tools.append([back.apply(driver.measured.pose.position), back.apply(driver.motion.reference.pose.position)])
        tools[-1].append(base.rotation.T @ driver.measured.velocity[:3])
    assert np.allclose(tools[0], tools[1], atol=1e-6)


def test_an_arm_on_a_driving_base_keeps_its_posture(robot):
    bench = Bench(robot)
    bench.run(0.1)
    q = bench.driver.measured.q
    bench.base = Pose(np.array([1.0, 0.0, 0.0]), np.eye(3))
    bench.driver._base = lambda: bench.base
    bench.run(0.0)
    assert bench.driver.measured.at_joints(q)
    assert bench.driver.motion.done


def test_taking_hold_of_a_tool_moves_nothing(robot):
    bench = Bench(robot)
    driver = bench.driver
    driver.motion.hold_position()
    bench.run(0.2)
    q, tool = driver.measured.q, bench.driver.measured.pose
    bench.model.site_pos[bench.model.site("tip").id, 2] += 0.08
    bench.run(0.5)
    assert np.abs(driver.measured.q - q).max() < 1e-4
    assert np.linalg.norm(driver.measured.pose.position - tool.position) == pytest.approx(0.08, abs=1e-4)
    assert np.abs(driver.motion.reference.pose.position - driver.measured.pose.position).max() < 1e-4


def test_a_motion_asked_for_right_after_taking_hold_is_made_with_the_tool(robot):
    bench = Bench(robot)
    driver = bench.driver
    driver.motion.hold_position()
    bench.run(0.1)
    bench.model.site_pos[bench.model.site("tip").id, 2] += 0.08
    bench.state_at_rest()
    start = driver.motion.stopping_pose()
    goal = moved_by(start, 0.0, 0.0, 0.05)
    driver.motion.move_along(path_through([start, goal], LIMITS))
    bench.until_done()
    bench.run(0.3)
    assert np.linalg.norm(start.position - bench.log["tool"][0]) == pytest.approx(0.08, abs=1e-3)
    assert np.abs(driver.measured.pose.position - goal.position).max() < 1e-3


def test_a_blocked_arm_is_noticed_and_can_go_on():
    bench = Bench("ur5e")
    driver = bench.driver
    bench.run(0.01)
    bench.model.actuator_gainprm[:] = 0.0
    bench.model.actuator_biasprm[:] = 0.0
    driver.motion.move_joints(np.array(HOMES["ur5e"]) + 1.0, 1.0)
    bench.run(1.5)
    assert "blocked" in driver.fault
