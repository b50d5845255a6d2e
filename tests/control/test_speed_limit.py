"""What becomes of joint motions for arms that take speeds, on joints that move exactly as told, or wrongly."""

from __future__ import annotations

import numpy as np
import pytest
from rig import Bench

from skillc_runtime.control.controller import ControlError
from skillc_runtime.control.limits import SpeedLimit
from skillc_runtime.devices.arm import ArmLimits, ArmState, JointVelocity

PULL, LAG = 5.0, 0.015
FASTEST, END = 1.0, 2.0


def limits(joints: int) -> ArmLimits:
    ends = np.repeat([[-END, END]], joints, axis=0)
    return ArmLimits(ends, np.full(joints, FASTEST), np.full(joints, 100.0), np.full(joints, np.inf))


def at(like: ArmState, q: np.ndarray, dq: np.ndarray) -> ArmState:
    return ArmState(q, dq, like.tool, like.jacobian, like.mass_matrix, like.bias, like.wrench, like.effort)


class Follower:
    """Joints that follow the speeds they are told `LAG` s late, times `scale`."""

    def __init__(self, period: float, scale: float = 1.0) -> None:
        self.like = Bench("ur5e").state()
        joints = self.like.q.size
        self.q, self.dq, self.speeds = np.zeros(joints), np.zeros(joints), []
        self.limit, self._period, self._scale = SpeedLimit(limits(joints), self.q, PULL, LAG), period, scale

    def step(self, q: np.ndarray) -> None:
        command = self.limit.step(q, at(self.like, self.q, self.dq), self._period)
        assert isinstance(command, JointVelocity)
        self.speeds.append(command.dq)
        self.dq += (1 - np.exp(-self._period / LAG)) * (self._scale * command.dq - self.dq)
        self.q = self.q + self._period * self.dq

    def swing(self, seconds: float) -> list[np.ndarray]:
        """Follow a sine of 0.2 rad; return where the joints are, 50 times a second."""
        found = []
        for step in range(1, round(seconds / self._period) + 1):
            self.step(np.full_like(self.q, 0.2 * np.sin(2 * step * self._period)))
            if step % round(0.02 / self._period) == 0:
                found.append(self.q)
        return found


def test_all_rates_lead_to_the_same() -> None:
    found = [np.array(Follower(period).swing(2.0)) for period in (0.001, 0.002, 0.004)]
    assert found[0].shape == (100, 6)
    assert np.ptp(found[0]) > 0.3
    for other, period in zip(found[1:], (0.002, 0.004), strict=True):
        assert np.abs(other - found[0]).max() < 0.4 * period


def test_being_late_as_expected_is_no_error() -> None:
    good = Follower(0.001)
    good.swing(2.0)
    wanted = 0.4 * np.cos(2 * np.arange(1, 2001) * 0.001)
    assert np.abs(np.array(good.speeds)[100:, 0] - wanted[100:]).max() < 0.005


@pytest.mark.parametrize("scale", [0.95, 1.05])
def test_wrong_speeds_do_not_add_up(scale: float) -> None:
    arm, exact = Follower(0.002, scale), Follower(0.002)
    error = np.abs(np.subtract(arm.swing(10.0), exact.swing(10.0))).max(axis=1)
    assert error.max() < 0.05 * 0.4 / PULL
    assert error[-100:].max() < 1.05 * error[:200].max()


def test_no_joint_is_told_to_be_too_fast_or_to_leave_its_range() -> None:
    chance, arm = np.random.default_rng(3), Follower(0.002, 1.05)
    reached = 0.0
    for _ in range(6):
        goal = chance.choice([-1.5, 1.5], arm.q.size) * END
        for _ in range(1500):
            arm.step(arm.q + np.clip(goal - arm.q, -0.01, 0.01))
        reached = max(reached, np.abs(arm.q).max())
    assert np.abs(arm.speeds).max() <= FASTEST + 1e-12
    assert 0.9 * END < reached < END + 1.05 * FASTEST * LAG


def test_joints_that_do_not_move_are_given_up() -> None:
    arm = Follower(0.002, 0.0)
    with pytest.raises(ControlError, match=r"0\.\d\d rad away .* blocked"):
        for step in range(1000):
            arm.step(np.full_like(arm.q, 0.002 * step))
    assert np.array_equal(arm.limit.q, arm.q)
    arm.step(arm.limit.q)
    assert not arm.speeds[-1].any()


def test_holding_at_once_means_where_joints_come_to_rest() -> None:
    arm = Follower(0.001)
    arm.swing(0.5)
    held = arm.limit.holding_joints(at(arm.like, arm.q, arm.dq)).copy()
    for _ in range(1000):
        arm.step(held)
    assert np.abs(arm.q - held).max() < 1e-3
    assert np.abs(arm.speeds[-1000:]).max() < 0.05
