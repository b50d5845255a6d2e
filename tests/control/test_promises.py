"""What a controller promises: bounded commands, no jumps, the same at every rate, holding when in doubt."""

import numpy as np
import pytest
from msgspec.structs import replace
from rig import GAINS, HOMES, LAWS, ROBOTS, Bench, moved_by

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.laws.controllers import make_controllers
from skillc_runtime.control.laws.task_error import EXERTED
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.control.limits import EFFORT
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import exp
from skillc_runtime.motion.reference import Compliance, Reference

LIMITS = MotionLimits(speed=0.2, acceleration=0.4)


def law_of(robot, bench, state):
    law = make_controllers(GAINS[robot], bench.limits, load_virtual_model(ROBOTS / f"{robot}.xml"), state, 0.001)
    law.tool.reset(state, state.q, np.zeros_like(state.q))
    return law.tool


def drawn(chance, robot, state):
    """A reference anywhere near and far, and a compliance of any kind."""
    pose = moved_by(state.tool, *chance.normal(0, 0.3, 3), turn=chance.normal(0, 1.0, 3))
    K = np.repeat([GAINS[robot].linear_stiffness, GAINS[robot].rotational_stiffness], 3)
    released = Compliance(K * chance.choice([0.0, 0.3, 1.0], 6), chance.normal(0, 50, 6), exp(chance.normal(0, 1, 3)))
    return Reference.of(pose, *chance.normal(0, 2, (2, 6))), released


def noted(bench):
    """The list of what the bench is told, growing: torques without bias, or joint positions."""
    told, command = [], bench.command

    def note(each):
        told.append(each.tau - bench.data.qfrc_bias if LAWS[bench.robot] == "impedance" else each.q.copy())
        command(each)

    bench.command = note
    return told


def test_no_reference_makes_the_tool_work_harder_than_skills_may_ask():
    bench, chance, worked = Bench("iiwa14"), np.random.default_rng(1), []
    limit = GAINS["iiwa14"].limits.force_n * GAINS["iiwa14"].limits.speed_m_s
    for _ in range(200):
        bench.data.qvel[:] = chance.normal(0, 1.0, 7)
        state = bench.state_at_rest()
        law = law_of("iiwa14", bench, state)
        law._memory = replace(law._memory, rest_stiffness=0.0, torque_rate=np.inf)
        law._memory.limits[EFFORT] = np.inf
        told = law.command(state, *drawn(chance, "iiwa14", state), 0.001)
        worked.append((told.tau - state.bias) @ state.dq)
    assert max(worked) == pytest.approx(limit)
    assert any(0 < each < 0.9 * limit for each in worked), "what needs less is left alone"
    assert min(worked) < -limit, "braking is not limited"


def test_no_reference_makes_springs_and_dampers_pull_harder_than_skills_may_ask():
    bench, chance, pulled = Bench("iiwa14"), np.random.default_rng(2), []
    for _ in range(100):
        bench.data.qvel[:] = chance.normal(0, 0.2, 7)
        state = bench.state_at_rest()
        law = law_of("iiwa14", bench, state)
        reference, compliance = drawn(chance, "iiwa14", state)
        law.command(state, reference, compliance, 0.001)
        pulled.append(np.linalg.norm(law._memory.task.rows[EXERTED, :3] - compliance.wrench[:3]))
    assert max(pulled) == pytest.approx(GAINS["iiwa14"].limits.force_n)
    assert min(pulled) < 0.9 * max(pulled), "what is less is left alone"


@pytest.mark.parametrize("elbow", [-1.0, -0.1, -0.01, 0.0, 0.01])
def test_near_and_at_a_singularity_commands_stay_within_limits(robot, elbow):
    bench, chance, period = Bench(robot), np.random.default_rng(3), 0.001
    joint = {"iiwa14": 3, "ur5e": 2}[robot]
    bench.data.qpos[joint] = elbow
    state = replace(bench.state_at_rest(), wrench=np.zeros(6))
    law = law_of(robot, bench, state)
    before = state.bias if LAWS[robot] == "impedance" else state.q
    for _ in range(50):
        command = law.command(state, *drawn(chance, robot, state), period)
        if LAWS[robot] == "impedance":
            assert (np.abs(command.tau) <= bench.limits.effort).all()
            assert np.abs(command.tau - before).max() <= GAINS[robot].law.torque_rate * period + 1e-9
            before = command.tau
        else:
            assert (np.abs(command.q - before) <= bench.limits.velocity * period + 1e-12).all()
            before = command.q
    assert np.abs(before - (state.bias if LAWS[robot] == "impedance" else state.q)).max() > 0


def test_whatever_is_changed_on_the_way_nothing_jumps(robot):
    bench = Bench(robot)
    driver, told, home = bench.driver, noted(bench), np.array(HOMES[robot])
    bench.run(0.05)
    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, moved_by(start, 0.0, 0.1, 0.0)], LIMITS))
    bench.run(0.3)
    driver.motion.move_joints(home + 0.1, 0.3)
    bench.run(0.2)
    driver.motion.hold_position()
    bench.run(0.1)
    driver.compliance.release(driver.measured.pose.rotation[:, 2])
    driver.compliance.push(driver.measured.pose.rotation[:, 2], 5.0)
    bench.run(0.1)
    driver.compliance.restore()
    bench.run(0.1)
    driver.motion.move_joints(home, 0.3)
    bench.run(0.3)
    steps = np.diff(told, axis=0)
    assert len(steps) > 1000
    if LAWS[robot] == "impedance":
        assert np.abs(steps).max() <= GAINS[robot].law.torque_rate * 0.001 + 1e-9
    else:
        velocity = steps / 0.001
        assert np.abs(velocity).max() > 0.05
        assert np.abs(np.diff(velocity, axis=0)).max() < 0.02, "rad/s from one period to the next"


def test_a_line_is_followed_alike_at_every_rate(robot):
    places = []
    for period in (0.001, 0.002, 0.004):
        bench = Bench(robot, period=period)
        start = bench.driver.motion.stopping_pose()
        bench.driver.motion.move_along(
            path_through([start, moved_by(start, 0.0, 0.05, 0.0, turn=(0.0, 0.0, 0.2))], LIMITS)
        )
        bench.run(0.8)
        places.append(np.array(bench.log["tool"])[round(0.1 / period) - 1 :: round(0.1 / period)])
    assert places[0].shape == (8, 3)
    assert np.ptp(places[0], axis=0).max() > 0.04
    # the log of a period is of its end, at the next one's start: what differs is less than a period's way
    for other, period in ((places[1], 0.002), (places[2], 0.004)):
        assert np.abs(other - places[0]).max() < 0.2 * period + 1e-4


@pytest.mark.parametrize("gap", [0.1, 3.0, -2.0])
def test_a_control_loop_that_was_late_goes_on_where_it_was(robot, gap):
    bench = Bench(robot)
    driver, told = bench.driver, noted(bench)
    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, moved_by(start, 0.0, 0.1, 0.0)], LIMITS))
    bench.run(0.4)
    before = driver.motion.reference.pose.position
    bench.data.time += gap
    bench.run(0.001)
    assert np.abs(driver.motion.reference.pose.position - before).max() <= 1.1 * LIMITS.speed * 0.001
    bench.until_done()
    assert np.allclose(driver.motion.reference.pose.position, moved_by(start, 0.0, 0.1, 0.0).position)
    steps = np.abs(np.diff(told, axis=0))
    most = GAINS[robot].law.torque_rate if LAWS[robot] == "impedance" else bench.limits.velocity
    assert (steps <= most * 0.001 + 1e-9).all()


def test_measurements_that_are_missing_leave_the_arm_holding(robot):
    bench = Bench(robot)
    driver, measure = bench.driver, bench.state
    start = driver.motion.stopping_pose()
    driver.motion.move_along(path_through([start, moved_by(start, 0.0, 0.1, 0.0)], LIMITS))
    bench.run(0.3)
    last, held = measure(), noted(bench)
    bench.state = lambda: replace(last, dq=np.full(bench.nv, np.nan))
    with pytest.raises(ControlError, match="not a number"):
        bench.run(0.001)
    assert len(held) == 1
    assert "not a number" in driver.broken
    expected = np.zeros(bench.nv) if LAWS[robot] == "impedance" else last.q
    assert np.allclose(held[0], expected, atol=0.5 if LAWS[robot] == "impedance" else 1e-3)
