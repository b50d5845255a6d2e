"""What a force sensor adds counts as 0 before a tool yields; what may be a contact does not."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from skillc_runtime.backends.mujoco.wrist import MEAN_S
from skillc_runtime.control.momentum_observer import MEASURING, estimate_wrench
from skillc_runtime.control.taring import (
    CAUTION,
    GREATEST_ERROR_N,
    GREATEST_N,
    LEAST_N,
    LEAST_N_M,
    PATIENCE_S,
    REST_AFTER_CONTACT_S,
    REST_S,
    Taring,
)
from skillc_runtime.motion.pose import Array

TICK_S = 0.01


@dataclass
class Hand:
    """An arm with a sensor that feels a wrench (6,), None without one, while its joints turn with a speed in rad/s."""

    mean_wrench: Array | None
    speed: float = 0.0
    tared: list[Array] = field(default_factory=list)
    force_drift: Array | None = None

    @property
    def dq(self) -> Array:
        return np.full(6, self.speed)

    def state(self) -> Hand:
        return self

    def pass_tick(self) -> None:
        """Do nothing."""

    def tare(self) -> None:
        assert self.mean_wrench is not None
        self.tared.append(self.mean_wrench)


def wait(taring: Taring, hand: Hand, moves_s: float = 0.0) -> float:
    """Call until nothing is left to be waited for, while the arm moves at first; return for how long, in s."""
    for tick in range(1000):
        hand.pass_tick()
        hand.speed = 1.0 if tick * TICK_S < moves_s else 0.0
        if taring.tare(5.0 + tick * TICK_S):
            return tick * TICK_S
    raise AssertionError("the wait has no end")


def feel(force_n: float, torque_n_m: float = 0.0) -> Hand:
    return Hand(np.array([0.0, 0.0, force_n, torque_n_m, 0.0, 0.0]))


def test_an_arm_without_sensor_waits_for_nothing() -> None:
    assert Taring(Hand(None)).tare(0.0)


@pytest.mark.parametrize("hand", [feel(3.0), feel(0.0, 0.2)])
def test_it_is_tared_once_it_has_rested(hand: Hand) -> None:
    assert wait(Taring(hand), hand, moves_s=0.5) == pytest.approx(0.5 + REST_S, abs=2 * TICK_S)
    assert len(hand.tared) == 1


@pytest.mark.parametrize("hand", [feel(1.01 * GREATEST_N), feel(0.99 * LEAST_N, 0.99 * LEAST_N_M)])
def test_a_contact_and_noise_are_not_subtracted(hand: Hand) -> None:
    assert wait(Taring(hand), hand) == pytest.approx(REST_S, abs=2 * TICK_S)
    assert hand.tared == []


def test_a_wrist_that_has_felt_a_contact_rests_longer() -> None:
    """Its mean forgets the greatest force that an arm may push with down to what is subtracted."""
    hand = feel(3.0)
    taring, waited = Taring(hand), 0
    while not taring.tare(waited * TICK_S, has_touched=True):
        waited += 1
    assert waited * TICK_S == pytest.approx(REST_AFTER_CONTACT_S, abs=2 * TICK_S)
    assert 50.0 * np.exp(-REST_AFTER_CONTACT_S / MEAN_S) < LEAST_N


def test_an_arm_that_never_rests_is_not_waited_for_for_ever() -> None:
    hand = feel(3.0)
    assert wait(Taring(hand), hand, moves_s=100.0) == pytest.approx(PATIENCE_S, abs=2 * TICK_S)
    assert hand.tared == []


def test_each_wait_begins_anew() -> None:
    hand = feel(3.0)
    taring = Taring(hand)
    assert [wait(taring, hand) > 0.5 * REST_S for _ in range(3)] == [True] * 3


def test_before_its_tool_is_controlled_it_is_tared_once_and_only_of_what_is_no_rest_of_a_motion() -> None:
    hand = feel(4 * LEAST_N)
    taring = Taring(hand)
    taring.tare_first(hand.dq)
    assert hand.tared == []
    moving, still = feel(4.0), feel(4.0)
    Taring(moving).tare_first(np.ones(6))
    assert moving.tared == []
    taring = Taring(still)
    for _ in range(3):
        taring.tare_first(still.dq)
    assert len(still.tared) == 1


NOISE_N_M_S = 0.005


class TorqueArm(Hand):
    """An arm with torque sensors whose bias is wrong by a torque (7,) in N m, with noise in the speeds it measures."""

    jacobian = np.hstack([np.eye(6), np.ones((6, 1))])

    def __init__(self, wrong: Array) -> None:
        super().__init__(None)
        self.wrong, self.added = wrong.copy(), np.zeros(8)
        self.felt, self.impulse = np.zeros(7), np.zeros(8)
        self.noise = np.random.default_rng(0)

    def correct_bias(self, torque: Array) -> None:
        self.wrong += torque

    def pass_tick(self) -> None:
        self.felt[:] += self.wrong * TICK_S
        self.impulse[0] += TICK_S
        self.impulse[1:] = self.felt + self.noise.normal(0.0, NOISE_N_M_S, 7)


def taring_of(arm: TorqueArm) -> Taring:
    taring = Taring(arm)
    taring.impulse = arm.impulse
    return taring


@given(arrays(float, 7, elements=st.floats(-3.0, 3.0)))
def test_an_arm_with_torque_sensors_corrects_its_bias_at_rest(wrong: Array) -> None:
    """Of n measurements n / (n + 3) is corrected, and their noise is that of the whole rest, not of each.

    What is felt as less than the noise of the mean stays as it is.
    """
    arm, felt = TorqueArm(wrong), np.empty(6)
    assert wait(taring_of(arm), arm) == pytest.approx(REST_S, abs=2 * TICK_S)
    if np.allclose(arm.wrong, wrong, rtol=0.0, atol=1e-12):
        estimate_wrench(felt, wrong, TorqueArm.jacobian, MEASURING)
        assert np.linalg.norm(felt[:3]) < 1.5 * LEAST_N and np.linalg.norm(felt[3:]) < 1.5 * LEAST_N_M
        return
    left = CAUTION / (REST_S / TICK_S) * np.abs(wrong)
    assert (np.abs(arm.wrong) <= left + 6 * 2 * NOISE_N_M_S / REST_S).all()


def test_what_it_touches_is_not_corrected_nor_what_it_feels_while_it_moves() -> None:
    touching = TorqueArm(TorqueArm.jacobian.T @ np.array([0.0, 0.0, 1.5 * GREATEST_ERROR_N, 0.0, 0.0, 0.0]))
    before = touching.wrong.copy()
    wait(taring_of(touching), touching)
    np.testing.assert_array_equal(touching.wrong, before)
    moving = TorqueArm(np.ones(7))
    assert wait(taring_of(moving), moving, moves_s=100.0) == pytest.approx(PATIENCE_S, abs=2 * TICK_S)
    np.testing.assert_array_equal(moving.wrong, 1.0)


@pytest.mark.parametrize(("drift_n_s", "fails"), [(0.1, False), (0.3, True)])
def test_a_sensor_that_drifts_too_fast_is_a_fault(drift_n_s: float, fails: bool) -> None:
    hand = feel(1.0)
    hand.force_drift = np.array([0.0, 0.0, drift_n_s])
    taring = Taring(hand, 0.2)
    wait(taring, hand)
    reason = taring.take_fault()
    assert (reason is not None) is fails
    if fails:
        assert reason == (
            "the force sensor drifts by 0.30 N/s, beyond the 0.2 N/s that it may: it is not warm yet, or broken"
        )
    assert taring.take_fault() is None
