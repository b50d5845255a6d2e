"""What every backend must do: go to poses, press, yield, refuse, hold still when nobody commands it, stop."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from typing import Any, get_args

import numpy as np
import pytest

from backends.backend import BACKENDS, Backend, MakeBackend
from skillc_runtime.devices.arm import ArmLoad, JointPosition, JointVelocity, Mode, ModeRefused, NotOffered, Torque
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Array, Pose

LIMITS = MotionLimits(speed=0.2, acceleration=0.5)
SLOW = MotionLimits(speed=0.03, acceleration=0.5)
COMMANDS = {"torque": Torque, "position": JointPosition, "velocity": JointVelocity}


def _backends() -> list[object]:
    """Return all of them; one of each mode is fast, the others and most threads belong to the simulations."""
    slow = ("panda", "thread ur5e velocity", "thread iiwa14")

    def mark(name: str) -> Any:
        if name.startswith("toy"):
            return (pytest.mark.robot, pytest.mark.long) if name.endswith("ur5e") else pytest.mark.robot
        return pytest.mark.sim if name.endswith(slow) else ()

    return [pytest.param(each, marks=mark(each)) for each in sorted(BACKENDS)]


@pytest.fixture(scope="module", params=_backends())
def make(request: pytest.FixtureRequest) -> Iterator[MakeBackend]:
    with ExitStack() as opened:
        yield BACKENDS[request.param](opened)


@pytest.fixture
def backend(make: MakeBackend) -> Iterator[Backend]:
    made = make()
    made.driver.motion.hold_position()
    made.advance(0.02)
    yield made
    made.close()


def beside(backend: Backend, *way: float) -> Pose:
    anchor = backend.driver.motion.stopping_pose()
    return Pose(anchor.position + np.array(way), anchor.rotation)


def go(backend: Backend, target: Pose, seconds: float) -> None:
    backend.driver.motion.move_along(path_through([backend.driver.motion.stopping_pose(), target], LIMITS))
    backend.advance(seconds)


def press(backend: Backend, force_n: float) -> Array:
    """Press against a wall 2 mm before the tool; return the direction out of it."""
    normal = backend.put_wall(0.002)
    backend.driver.compliance.release(normal)
    backend.driver.compliance.push(normal, force_n)
    backend.advance(0.7)
    return normal


@pytest.mark.slow
def test_nobody_can_change_what_was_measured(backend: Backend) -> None:
    state = backend.arm.state()
    arrays = [state.tool.position, state.tool.rotation, *(getattr(state, name) for name in state.__struct_fields__)]
    assert not any(array.flags.writeable for array in arrays if isinstance(array, np.ndarray))
    q = backend.driver.measured.q
    q += 1.0
    assert np.abs(backend.driver.measured.q - q).min() > 0.9, "what skills see is a copy"


def mean_force(backend: Backend, seconds: float = 0.1) -> float:
    return float(np.mean(backend.watch(seconds, lambda: backend.force_n)))


def test_what_it_says_of_itself_is_consistent(backend: Backend) -> None:
    offered, state = backend.arm.capabilities, backend.arm.state()
    joints = state.q.size
    assert backend.arm.interface in offered.modes
    assert set(offered.modes) <= set(get_args(Mode))
    assert (
        state.dq.shape == state.bias.shape == offered.limits.velocity.shape == offered.limits.effort.shape == (joints,)
    )
    assert state.jacobian.shape == (6, joints)
    assert state.mass_matrix.shape == (joints, joints)
    assert (np.linalg.eigvalsh(state.mass_matrix) > 0).all()
    assert (offered.limits.range[:, 0] <= state.q).all()
    assert (state.q <= offered.limits.range[:, 1]).all()
    assert offered.feels_force or not state.wrench.any()


def test_a_step_of_the_pose(backend: Backend) -> None:
    start, target = backend.driver.motion.stopping_pose(), beside(backend, 0.0, 0.03, 0.02)
    go(backend, target, 1.2)
    assert backend.driver.motion.done
    assert backend.driver.motion.tracking_error_message is None
    assert np.abs(backend.driver.measured.pose.position - target.position).max() < 1e-3
    assert np.abs(backend.driver.measured.pose.rotation - start.rotation).max() < 1e-2


@pytest.mark.slow
def test_steps_of_the_force(backend: Backend) -> None:
    normal = press(backend, 8.0)
    assert mean_force(backend) == pytest.approx(8.0, rel=0.05)
    backend.driver.compliance.push(normal, 16.0)
    backend.advance(0.6)
    assert mean_force(backend) == pytest.approx(16.0, rel=0.05)


def test_stiffness_that_changes_in_contact_does_not_make_it_jump(backend: Backend) -> None:
    press(backend, 10.0)
    before = mean_force(backend, 0.05)
    backend.driver.compliance.restore()
    forces = backend.watch(0.15, lambda: backend.force_n)
    assert before == pytest.approx(10.0, rel=0.1)
    assert np.abs(np.diff([before, *forces])).max() < 1.5
    assert max(forces) < 12.0
    assert (np.array(backend.driver.compliance.commanded_stiffness) > 0).all()


def test_what_it_cannot_do_is_refused_and_it_goes_on_as_before(backend: Backend) -> None:
    arm, driver, joints = backend.arm, backend.driver, backend.arm.state().q.size
    before = arm.interface
    others = [mode for mode in get_args(Mode) if mode not in arm.capabilities.modes]
    for mode in others:
        with pytest.raises(ModeRefused, match="the arm takes"):
            arm.switch(mode)
    arm.switch(before)
    for mode, wrong in COMMANDS.items():
        if mode != before:
            with pytest.raises(TypeError, match="takes no"):
                arm.command(wrong(np.zeros(joints)))
    with pytest.raises(ValueError, match="beyond"):
        driver.compliance.push(-driver.measured.pose.rotation[:, 2], 1000.0)
    assert arm.interface == before
    target = beside(backend, 0.0, 0.0, 0.02)
    go(backend, target, 0.8)
    assert np.abs(driver.measured.pose.position - target.position).max() < 1e-3


def test_it_changes_its_mode_on_the_way_without_a_jump_and_rests_until_the_first_command(backend: Backend) -> None:
    arm, driver, before = backend.arm, backend.driver, backend.arm.interface
    driver.motion.move_along(path_through([driver.motion.stopping_pose(), beside(backend, 0.0, 0.08, 0.0)], LIMITS))
    for mode in (*arm.capabilities.modes, before):
        backend.advance(0.25)
        if mode == before:
            arm.switch(mode)
        else:
            check_change_of_mode(backend, mode, before)
    backend.advance(1.0)
    assert driver.motion.done
    assert driver.motion.tracking_error_message is None


def check_change_of_mode(backend: Backend, mode: Mode, before: Mode) -> None:
    """Check that an arm that is switched on its way comes to rest, and forgets commands of both modes."""
    arm = backend.arm
    with backend.at_once():
        arm.switch(mode)
        backend.neglect()
    assert arm.interface == mode
    speeds = backend.watch(0.2, lambda: arm.state().dq.copy())
    assert np.abs(speeds[0]).max() > 0.01
    assert np.abs(np.diff(speeds, axis=0)).max() < 40.0 * backend.period_s, "rad/s^2 from one period to the next"
    assert np.abs(speeds[-1]).max() < 0.02
    with backend.at_once():
        arm.switch(before)
        backend.attend()
    backend.advance(0.1)
    with backend.at_once():
        moving = arm.state().dq.copy()
        arm.switch(mode)
        arm.switch(before)
        backend.neglect()
    backend.advance(0.04)
    assert np.abs(arm.state().dq).max() < 0.3 * np.abs(moving).max(), "what was told before is forgotten"
    backend.attend()


def test_a_motion_of_the_joints_that_runs_into_something_does_not_press_ever_harder(backend: Backend) -> None:
    driver = backend.driver
    deeper = beside(backend, *(-0.04 * backend.put_wall(0.002)))
    goal = driver.motion.inverse_kinematics(deeper, driver.measured.q)
    assert goal is not None
    driver.motion.move_joints(goal, 0.2)
    forces = [0.0]
    while driver.fault is None and len(forces) < 200:
        backend.advance(0.005)
        forces.append(backend.force_n)
    driver.hold_still("enough")
    forces += backend.watch(0.1, lambda: backend.force_n)  # A servo that is late goes on while it is braked.
    backend.advance(0.4)
    assert max(forces) > 40.0
    assert mean_force(backend) < 1.05 * max(forces)


def test_an_arm_that_nobody_commands_holds_still_and_goes_on_without_a_jump(backend: Backend) -> None:
    driver = backend.driver
    driver.motion.move_along(path_through([driver.motion.stopping_pose(), beside(backend, 0.0, 0.08, 0.0)], SLOW))
    backend.advance(0.4)
    assert np.abs(driver.measured.velocity[:3]).max() > 0.5 * SLOW.speed
    backend.neglect()
    assert not driver.motion.done
    backend.advance(0.6)
    stopped = backend.arm.state()
    assert np.abs(stopped.dq).max() < 0.02
    place = stopped.tool.position.copy()
    backend.advance(0.2)
    assert np.abs(backend.arm.state().tool.position - place).max() < 1e-3
    backend.attend()
    speeds = []
    for _ in range(20):
        backend.advance(0.01)
        speeds.append(np.abs(driver.measured.velocity[:3]).max())
    assert max(speeds) < driver.task_limits.speed_m_s


def test_it_stops_at_once(backend: Backend) -> None:
    driver = backend.driver
    driver.motion.move_along(path_through([driver.motion.stopping_pose(), beside(backend, 0.0, 0.08, 0.0)], LIMITS))
    backend.advance(0.4)
    where = driver.measured.pose.position
    driver.hold_still("enough")
    backend.advance(0.6)
    assert driver.fault == "enough"
    assert np.abs(driver.measured.velocity[:3]).max() < 0.01
    assert np.linalg.norm(driver.measured.pose.position - where) < 0.02


@pytest.mark.slow
def test_it_lets_go_when_it_stops_in_contact(backend: Backend) -> None:
    """What is left is what the wall, which springs back, pushes against the stiff arm."""
    press(backend, 10.0)
    backend.driver.abort("enough")
    backend.driver.secure()
    backend.advance(0.6)
    assert mean_force(backend, 0.05) < 10.0 / 3
    assert np.linalg.norm(np.nan_to_num(backend.driver.compliance.commanded_force)) < 0.1
    assert backend.driver.compliance.commanded_stiffness.all()


def test_its_own_model_has_the_flange_where_it_is(backend: Backend) -> None:
    """The tool stays where it was in the flange, however the joints move; an arm without a model of its own says so."""
    state = backend.arm.state()
    flange = backend.arm.flange_at(state.q)
    if flange is None:
        return
    in_flange = flange.inverse() @ state.tool
    go(backend, beside(backend, 0.0, 0.04, 0.03), 1.5)
    with backend.at_once():
        state = backend.arm.state()
        moved = backend.arm.flange_at(state.q)
    assert moved is not None
    assert np.abs(moved.position - flange.position).max() > 0.02
    expected = moved @ in_flange
    np.testing.assert_allclose(state.tool.position, expected.position, atol=1e-6)
    np.testing.assert_allclose(state.tool.rotation, expected.rotation, atol=1e-6)


def test_the_tool_centre_point_follows_the_load_and_returns_on_release(backend: Backend) -> None:
    with backend.at_once():
        before = backend.arm.state().tool
        before = Pose(before.position.copy(), before.rotation.copy())
        down = Pose(np.array([0.0, 0.0, 0.05]), np.eye(3))
        backend.arm.set_load(ArmLoad(0.2, np.zeros(3), down, down))
        held = (before.inverse() @ backend.arm.state().tool).position
        backend.arm.set_load(None)
        after = backend.arm.state().tool.position.copy()
    np.testing.assert_allclose(held, down.position, atol=1e-5)
    np.testing.assert_allclose(after, before.position, atol=1e-5)


def test_what_it_measures_is_dated_by_its_own_clock(backend: Backend) -> None:
    stamps = backend.watch(0.05, lambda: backend.arm.measured_s)
    known = [each for each in stamps if each is not None]
    assert len(known) in (0, len(stamps)) and len(stamps) > 3
    assert known == sorted(known)
    assert not known or known[-1] > known[0]


def test_it_is_tared_in_free_space_or_says_that_it_cannot_be(backend: Backend) -> None:
    if not backend.arm.capabilities.feels_force:
        with pytest.raises(NotOffered, match="sensor"):
            backend.arm.tare()
        return
    press(backend, 16.0)
    before = np.linalg.norm(backend.arm.state().wrench)
    backend.arm.tare()
    wrenches = backend.watch(0.01, lambda: backend.arm.state().wrench.copy())
    assert before > 10.0
    assert np.linalg.norm(np.mean(wrenches, axis=0)) < 0.3 * before, "from then on, the push begins to press harder"


def test_brakes_hold_it_whatever_is_commanded(backend: Backend) -> None:
    try:
        backend.arm.set_brakes(True)
    except NotOffered:
        assert not backend.arm.braked
        return
    backend.arm.set_brakes(False)
    go(backend, beside(backend, 0.0, 0.01, 0.0), 0.6)
    assert backend.driver.motion.done, "released brakes hold nothing"
    start = backend.arm.state().q.copy()
    backend.arm.set_brakes(True)
    go(backend, beside(backend, 0.0, 0.03, 0.0), 0.3)
    assert backend.arm.braked
    assert np.abs(backend.arm.state().q - start).max() < 2e-3
