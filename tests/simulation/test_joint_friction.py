"""Friction of joints: what sticks holds still, what slips is braked, and energy is only taken."""

from math import exp, inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.backends.simulation.arms.geometry_errors import WAVES, find_wave
from skillc_runtime.backends.simulation.arms.joint_friction import BENDING_RAD, STICKING, VISCOUS, Friction, rub

STEP_S, SLOW_N_M, INERTIA = 0.001, 5.0, 0.5


def rubbing(
    applied: np.ndarray, dq: np.ndarray, bent: float = 0.0, added: float = 0.0, time_s: float = inf, bias: float = 0.0
) -> Friction:
    """Return the friction of a joint whose arm makes up for it with a time constant."""
    share, none, strong = 1.0 - exp(-STEP_S / time_s), np.zeros(1), np.full(1, inf)
    slow = np.full(1, SLOW_N_M)
    return Friction(
        applied, slow, dq, np.full(1, bent), added, STEP_S, np.zeros(1), share, np.full(1, bias), none, none, none,
        none, none, none, strong, strong,
    )  # fmt: skip


def exert(control: float, more: float, servo: tuple[float, float], q: float = 0.0, wave: float = 0.0) -> float:
    """Return all that a motor with 10 N m, of which it really has 9, exerts on a joint without friction."""
    applied, none, effort = np.zeros(1), np.zeros(1), np.full(1, 10.0)
    stiffness, damping = (np.full(1, each) for each in servo)
    held = np.full(1, control)
    rub(
        Friction(
            applied, none, none.copy(), none.copy(), 1.0, STEP_S, np.full(1, more), 0.0, none, np.full(1, q), none,
            np.full(1, wave), held, stiffness, damping, effort, effort - 1.0,
        ), 0.0,
    )  # fmt: skip
    actuator = control if stiffness[0] == 0.0 else stiffness[0] * (control - q)
    return float(np.clip(actuator, -10.0, 10.0) + applied[0])


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))
def test_a_motor_exerts_no_more_than_it_really_can(control: float, more: float) -> None:
    """What an arm adds against friction counts, too; a servo that is asked for little does as it is asked."""
    assert exert(control, more, (0.0, 0.0)) == pytest.approx(np.clip(np.clip(control, -10, 10) + more, -9.0, 9.0))
    assert exert(control, 0.0, (100.0, 1.0)) == pytest.approx(np.clip(100.0 * control, -9.0, 9.0))


@given(st.floats(-3.0, 3.0))
def test_a_wave_is_about_a_sine_and_has_its_slope(q: float) -> None:
    (here, slope), step = find_wave(q), 1e-7
    ahead, behind = find_wave(q + step)[0], find_wave(q - step)[0]
    assert abs(here - np.sin(WAVES * q)) < 0.06
    assert (ahead - behind) / (2 * step) == pytest.approx(slope, abs=0.05 * WAVES)


@given(st.floats(-3.0, 3.0), st.floats(1e-5, 3e-4))
def test_a_servo_holds_the_angle_that_its_encoder_measures(q: float, wave: float) -> None:
    measured = q + wave * find_wave(q)[0]
    assert exert(measured, 0.0, (100.0, 1.0), q, wave) == pytest.approx(0.0, abs=1e-9)


def turn(
    torque_n_m: float, speed: float, seconds: float, time_s: float = inf, bias: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Return angles and speeds of a joint on which a torque acts from a speed on, as the simulation integrates."""
    applied, dq, angles, speeds, q = np.zeros(1), np.full(1, speed), [], [], 0.0
    friction = rubbing(applied, dq, time_s=time_s, bias=bias)
    for _ in range(round(seconds / STEP_S)):
        rub(friction, 0.0)
        dq += STEP_S * (torque_n_m + applied) / INERTIA
        q += STEP_S * float(dq[0])
        angles.append(q)
        speeds.append(float(dq[0]))
    return np.array(angles), np.array(speeds)


@given(st.floats(-1.0, 1.0))
def test_a_joint_at_rest_bears_what_is_less_than_its_friction(share: float) -> None:
    """A load that comes suddenly bends it by up to twice what it bends it at rest, and does not let it creep."""
    angles, speeds = turn(0.4 * share * STICKING * SLOW_N_M, 0.0, 2.0)
    assert np.abs(angles).max() < 2 * BENDING_RAD
    assert abs(angles[-1] - angles[-500]) < 1e-7 and abs(speeds[-1]) < 1e-6


def test_a_joint_that_is_pushed_harder_slips_and_reaches_the_speed_that_friction_allows() -> None:
    _, speeds = turn(2.0 * SLOW_N_M, 0.0, 10.0)
    final = float(speeds[-1])
    sticking = 1.0 + (STICKING - 1.0) / (1.0 + (final / 0.05) ** 2)
    assert abs(SLOW_N_M * (sticking + VISCOUS * final) - 2.0 * SLOW_N_M) < 0.01 * SLOW_N_M


@given(st.floats(0.01, 3.0))
def test_a_joint_that_moves_comes_to_rest_and_stays(speed: float) -> None:
    _, speeds = turn(0.0, speed, 3.0)
    energies = 0.5 * INERTIA * speeds**2
    assert energies[-1] < 1e-9
    assert energies.max() <= 0.5 * INERTIA * speed**2


def test_motors_that_write_torques_in_each_step_have_it_added() -> None:
    applied, dq = np.full(1, 7.0), np.full(1, 1.0)
    rub(rubbing(applied, dq, BENDING_RAD, 1.0), 0.0)
    assert 7.0 - 2 * SLOW_N_M < applied[0] < 7.0 - 0.9 * SLOW_N_M


@given(st.floats(0.02, 3.0))
def test_an_arm_with_torque_sensors_moves_as_without_friction(torque_n_m: float) -> None:
    """Even a torque that friction would hold accelerates the joint, once that is noticed."""
    _, speeds = turn(torque_n_m, 0.0, 2.0, time_s=0.005)
    gained = INERTIA * (speeds[-1] - speeds[-501]) / 0.5
    assert gained == pytest.approx(torque_n_m, rel=0.1, abs=0.02)


@given(st.floats(-3.0, 3.0), st.floats(0.001, 0.02))
def test_what_makes_up_for_friction_adds_no_energy(speed: float, time_s: float) -> None:
    _, speeds = turn(0.0, speed, 2.0, time_s)
    assert np.abs(speeds).max() <= abs(speed) + 1e-9


@given(st.floats(-0.5, 0.5))
def test_what_a_torque_sensor_adds_is_what_the_link_misses(bias: float) -> None:
    _, speeds = turn(bias, 0.0, 2.0, time_s=0.005, bias=bias)
    assert np.abs(speeds[500:] - speeds[500]).max() < 1e-3
