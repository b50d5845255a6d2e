"""Properties of the two laws: what must hold whatever the numbers are."""

from typing import get_args

import numpy as np
import pytest
from msgspec.structs import replace
from rig import GAINS, ROBOTS, Bench, moved_by

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.gains import CONTROLLERS, LawGains, OwnGains, UnknownController, read_gains
from skillc_runtime.control.laws.controllers import make_controllers
from skillc_runtime.control.laws.damping import damping_rate
from skillc_runtime.control.laws.nullspace import REGULARISATION, posture_torque
from skillc_runtime.control.laws.virtual_arm import load_virtual_model
from skillc_runtime.motion.pose import Pose, exp, log
from skillc_runtime.motion.reference import Compliance, Reference, resting_reference


def stiff(robot, frame=None, scale=1.0):
    g = GAINS[robot]
    K = np.repeat([g.linear_stiffness, g.rotational_stiffness], 3) * scale
    return Compliance(K, np.zeros(6), np.eye(3) if frame is None else frame)


def fresh(robot):
    """A bench and a law that starts from its state."""
    bench = Bench(robot)
    state = replace(bench.state(), wrench=np.zeros(6))
    model = load_virtual_model(ROBOTS / f"{robot}.xml")
    law = make_controllers(GAINS[robot], bench.limits, model, state, 0.001).tool
    law.reset(state, state.q, np.zeros_like(state.q))
    return bench, state, law


def output(robot, bench, command):
    """What the law adds to holding still."""
    return command.tau - bench.state().bias if robot == "iiwa14" else command.q - bench.state().q


def test_no_error_no_command(robot):
    bench, state, law = fresh(robot)
    for _ in range(5):
        command = law.command(state, resting_reference(state.tool), stiff(robot), 0.001)
    assert np.abs(output(robot, bench, command)).max() < 1e-9


def test_an_isotropic_compliance_does_not_depend_on_its_frame(robot):
    outputs = []
    for turn in ([0, 0, 0], [0.3, -1.0, 2.0], [0, np.pi / 2, 0]):
        bench, state, law = fresh(robot)
        goal = Reference.of(
            moved_by(state.tool, 0.01, -0.02, 0.005, turn=(0.02, 0.05, -0.03)),
            np.array([0.05, 0.02, -0.03, 0.1, 0.0, 0.2]),
            np.array([0.1, 0.2, 0.3, 0.0, 0.0, 0.1]),
        )
        outputs.append(output(robot, bench, law.command(state, goal, stiff(robot, exp(np.array(turn))), 0.001)))
    assert np.abs(outputs[0]).max() > 0
    # the damping takes the diagonal of the inertia in C, so it alone depends on the frame; at rest it does not act
    scale = np.abs(outputs[0]).max()
    assert np.allclose(outputs[1], outputs[0], atol=(0.2 if robot == "iiwa14" else 1e-9) * scale)
    assert np.allclose(outputs[2], outputs[0], atol=(0.2 if robot == "iiwa14" else 1e-9) * scale)


def test_at_rest_the_frame_does_not_matter_at_all(robot):
    outputs = []
    for turn in ([0, 0, 0], [0.3, -1.0, 2.0]):
        bench, state, law = fresh(robot)
        goal = resting_reference(moved_by(state.tool, 0.001, -0.002, 0.0005))
        outputs.append(output(robot, bench, law.command(state, goal, stiff(robot, exp(np.array(turn))), 0.001)))
    assert np.abs(outputs[0]).max() > 0
    assert np.allclose(outputs[0], outputs[1], atol=1e-9)


def test_swapping_axes_and_frame_together_changes_nothing(robot):
    g = GAINS[robot]
    K = np.array([100.0, 200.0, 300.0, 10.0, 20.0, 30.0]) * g.linear_stiffness / 1000
    W = np.array([1.0, 2.0, 3.0, 0.1, 0.2, 0.3])
    swap = np.column_stack([[0.0, 1, 0], [-1.0, 0, 0], [0.0, 0, 1]])
    order, sign = [1, 0, 2, 4, 3, 5], np.array([1, -1, 1, 1, -1, 1])
    outputs = []
    for compliance in (Compliance(K, W, np.eye(3)), Compliance(K[order], W[order] * sign, swap)):
        bench, state, law = fresh(robot)
        goal = resting_reference(moved_by(state.tool, 0.001, -0.002, 0.0005))
        outputs.append(output(robot, bench, law.command(state, goal, compliance, 0.001)))
    assert np.allclose(outputs[0], outputs[1], atol=1e-9)


def test_a_push_is_exerted_by_the_springless_arm():
    bench, state, law = fresh("iiwa14")
    wrench = np.array([0.1, 0.2, -0.3, 0.0, 0.0, 0.05])
    compliance = Compliance(np.zeros(6), wrench, np.eye(3))
    tau = output("iiwa14", bench, law.command(state, resting_reference(state.tool), compliance, 0.001))
    axes = state.tool.rotation
    in_base = np.concatenate([axes @ wrench[:3], axes @ wrench[3:]])
    assert np.allclose(tau, state.jacobian.T @ in_base, atol=1e-9)
    assert np.allclose(law.contact_wrench, -in_base)


def test_a_wrong_goal_gives_a_bounded_force():
    _, state, law = fresh("iiwa14")
    far = resting_reference(moved_by(state.tool, 0, 0, 5.0))
    for _ in range(400):
        law.command(state, far, stiff("iiwa14"), 0.001)
    assert np.linalg.norm(law.contact_wrench[:3]) == pytest.approx(GAINS["iiwa14"].limits.force_n)


def test_the_posture_is_kept_without_moving_the_tool():
    state = Bench("iiwa14").state()
    tau, rest = np.empty(7), state.q + np.linspace(-0.3, 0.3, 7)
    assert posture_torque(tau, state.q, state.dq, state.jacobian, rest, 10.0) == REGULARISATION
    singular = np.linalg.svd(state.jacobian, compute_uv=False)
    free = 10.0 * np.linspace(-0.3, 0.3, 7)
    leak = REGULARISATION / (singular.min() ** 2) * np.abs(state.jacobian @ free).max()
    assert np.abs(tau).max() > 0.1
    assert np.abs(state.jacobian @ tau).max() <= leak * 2 + 1e-9


def test_near_a_singularity_the_nullspace_is_damped_smoothly():
    bench, tau, seen = Bench("iiwa14"), np.empty(7), []
    for elbow in np.linspace(-1.6, 0.0, 40):
        bench.data.qpos[3] = elbow
        state = bench.state_at_rest()
        seen.append(posture_torque(tau, state.q, state.dq, state.jacobian, np.zeros(7), 10.0))
        assert np.isfinite(tau).all()
    assert seen[0] == REGULARISATION
    assert seen[-1] > 1e-3
    assert (np.diff(seen) >= 0).all()


def test_damping_too_fast_for_the_period_is_refused():
    bench = Bench("iiwa14")
    state = bench.state()
    rate = damping_rate(state, 60.0, 3.0)
    assert 0 < rate < 1000
    gains, model = GAINS["iiwa14"], load_virtual_model(ROBOTS / "iiwa14.xml")
    with pytest.raises(ValueError, match="too fast"):
        make_controllers(gains, bench.limits, model, state, 1.1 / rate)


def test_the_log_error_is_the_shortest_turn(robot):
    _, state, law = fresh(robot)
    turned = exp(np.array([0.0, 0.0, 0.2])) @ state.tool.rotation
    law.command(state, resting_reference(Pose(state.tool.position, turned)), stiff(robot), 0.001)
    axes = law._memory.task.axes
    assert np.allclose(axes @ law._memory.task.rows[0, 3:], log(state.tool.rotation @ turned.T))


def test_unknown_controllers_and_missing_numbers_are_named():
    known = "forward_dynamics, forward_dynamics_velocity, impedance, on_robot"
    with pytest.raises(UnknownController, match=f"no controller 'admittance'; there are: {known}$"):
        read_gains("admittance", {}.__getitem__)
    with pytest.raises(KeyError, match="dampingFloor"):
        read_gains("impedance", {}.__getitem__)


def test_every_controller_that_arms_may_name_is_one_of_the_gains_that_there_are():
    kinds = {type(read(lambda _: 1.0)) for read in CONTROLLERS.values()}
    assert kinds | {OwnGains} == set(get_args(LawGains))


def test_something_that_is_no_number_stops_the_arm(robot):
    bench = Bench(robot)
    bench.run(0.01)
    good = bench.state
    bench.state = lambda: replace(good(), dq=np.full(bench.nv, np.nan))
    with pytest.raises(ControlError, match="not a number"):
        bench.driver.step(0.011)
    assert np.isfinite(bench.data.ctrl).all()
