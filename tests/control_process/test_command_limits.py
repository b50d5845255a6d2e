"""Whatever a law wants, what a device is told keeps the limits of its joints."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.backends.control_process.periods.command_limits import CommandLimits, RateLimits
from skillc_runtime.control.controller import ControlError
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.motion.pose import Array

PERIOD_S, SPEED, ACCELERATION, JERK, EFFORT, RATE, END = 0.001, 2.0, 10.0, 5000.0, 50.0, 1000.0, 1.0
LIMITS = ArmLimits(np.array([[-END, END]] * 2), np.full(2, SPEED), np.full(2, EFFORT), np.full(2, ACCELERATION))
WANTED = st.lists(st.floats(-1.5, 1.5), min_size=1, max_size=6)


def made() -> CommandLimits:
    return CommandLimits(LIMITS, RateLimits(np.full(2, JERK), np.full(2, RATE)), PERIOD_S)


def follow(limits: CommandLimits, mode: str, wanted: list[float], cycles: int = 100) -> Array:
    """Return the commands (n,) for steps of what is wanted, each for some cycles."""
    told = []
    for goal in wanted:
        for _ in range(cycles):
            values = np.array([goal, 0.0])
            with suppress(ControlError):
                limits.apply(mode, values, np.zeros(2))  # type: ignore[arg-type]
            told.append(values[0])
    return np.array(told)


@pytest.mark.slow
@given(WANTED)
def test_positions_keep_range_speed_acceleration_and_jerk(wanted: list[float]) -> None:
    limits = made()
    limits.begin("position", np.zeros(2), np.zeros(2))
    told = follow(limits, "position", wanted)
    speed = np.diff(told, prepend=0.0) / PERIOD_S
    acceleration = np.diff(speed, prepend=0.0) / PERIOD_S
    assert np.abs(told).max() <= END
    assert np.abs(speed).max() <= SPEED + 1e-9
    inside = np.abs(told) < END
    assert np.abs(acceleration[inside]).max(initial=0.0) <= ACCELERATION + 1e-6


@given(WANTED)
def test_speeds_keep_acceleration_and_jerk(wanted: list[float]) -> None:
    limits = made()
    limits.begin("velocity", np.zeros(2), np.zeros(2))
    told = follow(limits, "velocity", [2 * each for each in wanted])
    acceleration = np.diff(told, prepend=0.0) / PERIOD_S
    assert np.abs(told).max() <= SPEED
    assert np.abs(acceleration).max() <= ACCELERATION + 1e-6
    assert np.abs(np.diff(acceleration, prepend=0.0)).max() <= JERK * PERIOD_S + 1e-6


@given(st.lists(st.floats(-200.0, 200.0), min_size=1, max_size=6))
def test_torques_keep_effort_and_rate(wanted: list[float]) -> None:
    limits = made()
    limits.begin("torque", np.zeros(2), np.zeros(2))
    told = follow(limits, "torque", wanted)
    assert np.abs(told).max() <= EFFORT
    assert np.abs(np.diff(told, prepend=0.0)).max() <= RATE * PERIOD_S + 1e-9


def test_a_smooth_motion_is_told_as_it_is() -> None:
    limits = made()
    limits.begin("position", np.zeros(2), np.zeros(2))
    follow(limits, "position", [0.0], 1000)
    time = np.arange(1, 2001) * PERIOD_S
    way = 0.2 * (1.0 - np.cos(np.pi * np.minimum(time, 2.0) / 2.0))
    told = follow(limits, "position", way.tolist(), 1)
    assert np.abs(told - way).max() < 1e-3


def test_a_jump_ends_where_it_was_to_go_without_swinging() -> None:
    limits = made()
    limits.begin("position", np.zeros(2), np.zeros(2))
    follow(limits, "position", [0.0], 1000)
    told = follow(limits, "position", [0.04], 600)
    assert told.max() < 0.0405
    assert abs(told[-1] - 0.04) < 1e-4


def test_what_is_far_beyond_the_limits_stops_the_arm() -> None:
    limits = made()
    limits.begin("position", np.zeros(2), np.zeros(2))
    with pytest.raises(ControlError, match="ahead of what the limits of the joints allow"):
        limits.apply("position", np.array([0.5, 0.0]), np.zeros(2))


@pytest.mark.parametrize(
    ("q", "dq", "says"), [(0.0, 2.5, "joint 2 moves with 2.50 rad/s"), (1.1, 0.0, "joint 2 is 0.100")]
)
def test_a_joint_beyond_its_limits_is_named(q: float, dq: float, says: str) -> None:
    limits = made()
    assert limits.check_measured(np.zeros(2), np.zeros(2)) is None
    assert says in str(limits.check_measured(np.array([0.0, q]), np.array([0.0, dq])))
