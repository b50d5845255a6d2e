"""The virtual arm: kinematics and inertia agree with pinocchio and MuJoCo; inverse kinematics round trips."""

import numpy as np
import pinocchio
import pytest
from rig import HOMES, ROBOTS, Bench, moved_by

from skillc_runtime.control.inverse_kinematics import solve_inverse_kinematics
from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model
from skillc_runtime.control.limits import range_margin
from skillc_runtime.motion.pose import Pose, exp, log


def peer(robot):
    """The arm in pinocchio, which ignores the pose of a first body without joint (its bug 2782): ours have none."""
    model = pinocchio.buildModelFromMJCF(str(ROBOTS / f"{robot}.xml"))
    return model, model.createData()


def postures(robot, count=25):
    draw = np.random.default_rng(3)
    return [np.array(HOMES[robot]) + draw.uniform(-1.0, 1.0, len(HOMES[robot])) for _ in range(count)]


def test_pose_and_jacobian_agree_with_pinocchio(robot):
    arm, (model, data) = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml")), peer(robot)
    flange = model.getFrameId("flange")
    for q in postures(robot):
        arm.update_kinematics(q)
        pinocchio.framesForwardKinematics(model, data, q)
        J = pinocchio.computeFrameJacobian(model, data, q, flange, pinocchio.LOCAL_WORLD_ALIGNED)
        assert np.allclose(arm.tool.position, data.oMf[flange].translation, atol=1e-12)
        assert np.allclose(arm.tool.rotation, data.oMf[flange].rotation, atol=1e-12)
        assert np.allclose(arm.jacobian, J, atol=1e-12)


def test_mass_matrix_agrees_with_pinocchio(robot):
    bench, (model, data) = Bench(robot), peer(robot)
    q = np.array(HOMES[robot])
    pinocchio.crba(model, data, q)
    M = np.triu(data.M) + np.triu(data.M, 1).T
    tool = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    tool.mount_tool(q, Pose(bench.data.xipos[bench.model.body("eraser").id], np.eye(3)))
    eraser = np.r_[np.full(3, 0.2), bench.model.body("eraser").inertia]
    R = bench.data.ximat[bench.model.body("eraser").id].reshape(3, 3)
    J = np.vstack([tool.jacobian[:3], R.T @ tool.jacobian[3:]])
    assert np.allclose(bench.state().mass_matrix, M + J.T @ (eraser[:, None] * J), atol=1e-9)


def test_virtual_inertia_is_that_of_the_stated_masses(robot):
    model = load_virtual_model(ROBOTS / f"{robot}.xml")
    arm = VirtualArm(model)
    q = np.array(HOMES[robot])
    arm.update_kinematics(q)
    arm.update_dynamics(np.zeros_like(q))
    assert not arm.bias.any()
    assert np.allclose(arm.inertia, arm.inertia.T)
    mobility = arm.jacobian @ np.linalg.solve(arm.inertia, arm.jacobian.T)
    assert np.linalg.eigvalsh(mobility).max() <= 1 + 1e-9  # the tool's own 1 kg and 1 kg m^2, and the links besides
    assert model.body_mass[model.body("tool").id] == 1.0


def test_a_virtual_arm_left_alone_moves_its_tool_straight_on(robot):
    """Coriolis forces are accounted for: without a wrench the tool keeps its twist, but for what light links add."""
    arm = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    q, dq, h = np.array(HOMES[robot]), np.random.default_rng(5).uniform(-1, 1, len(HOMES[robot])), 1e-6
    arm.update_kinematics(q + h * dq)
    ahead = arm.jacobian.copy()
    arm.update_kinematics(q)
    arm.update_dynamics(dq)
    turning = (ahead - arm.jacobian) @ dq / h
    left = turning - arm.jacobian @ np.linalg.solve(arm.inertia, arm.bias)
    assert np.linalg.norm(turning) > 0.3
    assert np.linalg.norm(left) < 0.05 * np.linalg.norm(turning)


def test_a_mounted_tool_is_where_it_was_put(robot):
    arm = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    q, other = postures(robot, 2)
    arm.update_kinematics(q)
    hand = arm.tool
    on_hand = Pose(np.array([0.01, 0.02, 0.15]), exp(np.array([0.1, -0.3, 0.8])))
    arm.mount_tool(q, hand @ on_hand)
    arm.mount_tool(q, hand @ on_hand)
    assert np.allclose(arm.tool.position, (hand @ on_hand).position)
    bare = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    bare.update_kinematics(other)
    arm.update_kinematics(other)
    assert np.allclose(arm.tool.position, (bare.tool @ on_hand).position)
    assert np.allclose(arm.tool.rotation, (bare.tool @ on_hand).rotation)


def test_inverse_kinematics_round_trip(robot):
    bench = Bench(robot)
    arm = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    seed, found = np.array(HOMES[robot]), 0
    for q in postures(robot):
        q = np.clip(q, bench.limits.range[:, 0] + 0.1, bench.limits.range[:, 1] - 0.1)
        arm.update_kinematics(q)
        target = arm.tool
        solution = solve_inverse_kinematics(arm, target, seed, bench.limits.range)
        if solution is None:
            continue
        found += 1
        arm.update_kinematics(solution)
        assert np.abs(arm.tool.position - target.position).max() < 1e-4
        assert np.abs(log(arm.tool.rotation @ target.rotation.T)).max() < 1e-4
        assert (solution >= bench.limits.range[:, 0]).all()
        assert (solution <= bench.limits.range[:, 1]).all()
    assert found >= 24


def test_what_a_posture_reaches_may_be_reached(robot):
    arm = VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    arm.mount_tool(np.array(HOMES[robot]), arm.tool @ Pose.of((0.05, -0.1, 0.2)))
    for q in (np.zeros(arm.joints), *postures(robot)):
        arm.update_kinematics(q)
        assert arm.may_reach(arm.tool)
    assert not arm.may_reach(Pose.of((2.0, 0.0, 0.5)))


def test_inverse_kinematics_gives_up_out_of_reach_and_repeats_itself(robot):
    bench, arm = Bench(robot), VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    seed = np.array(HOMES[robot])
    assert solve_inverse_kinematics(arm, Pose.of((3.0, 0.0, 0.5)), seed, bench.limits.range) is None
    arm.update_kinematics(seed + 0.3)
    target = arm.tool
    first, second = (solve_inverse_kinematics(arm, target, seed, bench.limits.range) for _ in range(2))
    assert first is not None
    assert second is not None
    assert (first == second).all()


def test_the_driver_finds_joints_for_a_pose_in_the_world(robot):
    base = Pose(np.array([1.0, -2.0, 0.4]), exp(np.array([0, 0, 1.2])))
    driver = Bench(robot, base=base).driver
    q = driver.motion.inverse_kinematics(moved_by(driver.measured.pose, 0.02, 0.05, -0.03), driver.measured.q)
    assert q is not None
    assert np.abs(q - driver.measured.q).max() < 0.5
    assert driver.measured.pose.position == pytest.approx(
        Bench(robot).driver.measured.pose.position @ base.rotation.T + base.position
    )


@pytest.mark.slow
def test_joints_stay_away_from_the_ends_of_their_ranges_where_they_are_pushed_back(robot):
    bench, arm = Bench(robot), VirtualArm(load_virtual_model(ROBOTS / f"{robot}.xml"))
    limits, found = bench.limits.range, 0
    for joint in range(arm.joints):
        q = np.array(HOMES[robot])
        q[joint] = limits[joint, 1] - 0.01
        arm.update_kinematics(q)
        solution = solve_inverse_kinematics(arm, arm.tool, q, limits)
        if solution is not None:
            found += 1
            room = np.minimum(solution - limits[:, 0], limits[:, 1] - solution)
            assert (room >= range_margin(limits) - 1e-9).all()
    assert found > arm.joints / 2
