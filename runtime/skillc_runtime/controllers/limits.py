"""The last word before a command reaches an arm: what the arm can take, whichever law asks. One of them per arm."""

from __future__ import annotations

import numpy as np

from skillc_runtime.controllers.controller import ControlError
from skillc_runtime.motion.pose import Array
from skillc_runtime.numerics.compiled import OutMatrix, OutVector, Vector, compiled, part
from skillc_runtime.robots.arm import ArmLimits, ArmState

RANGE_MARGIN_RAD = 0.05
"""Within this distance of the end of its range a joint is pushed back, at the end with a quarter of its effort."""

GREATEST_LAG_RAD = 0.2
"""A position-controlled arm that lags behind its command by more, over all joints, is stuck."""

RAMP, LOW, HIGH, SPRING, EFFORT = range(5)
"""Rows of `TorqueLimit.rows`: torque so far, where joints are pushed back from, how hard, and the greatest torque."""

TOLD, SPEED, LEAST, MOST, FASTEST = range(5)
"""Rows of `JointLimit.rows`: positions and speeds commanded last, and their limits."""


class TorqueLimit:
    """Limits torques in rate, range and effort; since all laws share it, changing between them makes no jump.

    rows (5, nv) is what `limit_torque` knows; `rate` in N m/s holds for torques without bias.
    """

    def __init__(self, limits: ArmLimits, rate: float) -> None:
        low, high = limits.range[:, 0] + RANGE_MARGIN_RAD, limits.range[:, 1] - RANGE_MARGIN_RAD
        spring = limits.effort / 4 / RANGE_MARGIN_RAD
        self.rows: Array = np.array([np.zeros_like(low), low, high, spring, limits.effort])
        self.rate = rate

    def step(self, tau: Array, state: ArmState, period: float) -> Array:
        """Return what to command (nv,) in N m for torques without bias. A new array."""
        told = np.empty_like(tau)
        limit_torque(told, self.rows, tau, state.q, state.bias, self.rate * period)
        return told


class JointLimit:
    """Limits joint positions in range and speed. Laws continue from q and dq (nv,), which were commanded last."""

    def __init__(self, limits: ArmLimits, q: Array) -> None:
        self.rows: Array = np.array([q, np.zeros_like(q), *limits.range.T, limits.velocity])
        self.q: Array = self.rows[TOLD]
        self.dq: Array = self.rows[SPEED]

    def step(self, q: Array, state: ArmState, period: float) -> Array:
        """Return what to command (nv,) in rad, a new array.

        ControlError when the arm does not follow; it is then commanded to stay where it is.
        """
        return self.followed(limit_joints(self.rows, q, state.q, period), state)

    def followed(self, followed: bool, state: ArmState) -> Array:
        """Return what `limit_joints` left to command, a new array, if it found the arm to follow; else as `step`."""
        if followed:
            return self.q.copy()
        lag = np.abs(self.q - state.q).max()
        self.q[:], self.dq[:] = state.q, 0.0
        raise ControlError(f"a joint is {lag:.2f} rad away from where it was commanded to be; is the arm blocked?")


@part
def _within(x: float, least: float, most: float) -> float:
    """Return what is nearest to x between two limits; what is no number stays none."""
    if x < least:
        return least
    return most if x > most else x


@compiled
def limit_torque(told: OutVector, rows: OutMatrix, tau: Vector, q: Vector, bias: Vector, longest: float) -> None:
    """Let the ramp follow tau by steps of at most `longest`; add the bias and what pushes joints back into range."""
    for j in range(told.size):
        rows[RAMP, j] += _within(tau[j] - rows[RAMP, j], -longest, longest)
        back = rows[SPRING, j] * (_within(q[j], rows[LOW, j], rows[HIGH, j]) - q[j])
        told[j] = _within(rows[RAMP, j] + back + bias[j], -rows[EFFORT, j], rows[EFFORT, j])


@compiled
def limit_joints(rows: OutMatrix, q: Vector, measured: Vector, period: float) -> bool:
    """Let what is told follow q within limits; return False, and do nothing, when the arm is too far."""
    square = 0.0
    for j in range(q.size):
        lag = rows[TOLD, j] - measured[j]
        square += lag * lag
    if square > GREATEST_LAG_RAD * GREATEST_LAG_RAD:
        return False
    for j in range(q.size):
        told, longest = rows[TOLD, j], rows[FASTEST, j] * period
        wanted = told + _within(q[j] - told, -longest, longest)
        rows[TOLD, j] = _within(wanted, rows[LEAST, j], rows[MOST, j])
        rows[SPEED, j] = (rows[TOLD, j] - told) / period
    return True
