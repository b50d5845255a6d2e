"""The last word before a command reaches an arm: what the arm can take, whichever law asks. One of them per arm."""

from __future__ import annotations

import numpy as np

from skillc_runtime.controllers.controller import ControlError
from skillc_runtime.motion.pose import Array
from skillc_runtime.numerics.compiled import OutVector, Vector, compiled
from skillc_runtime.robots.arm import ArmLimits, ArmState

RANGE_MARGIN_RAD = 0.05
"""Within this distance of the end of its range a joint is pushed back, at the end with a quarter of its effort."""

GREATEST_LAG_RAD = 0.2
"""A position-controlled arm that lags behind its command by more, over all joints, is stuck."""


class TorqueLimit:
    """Limits torques in rate, range and effort; since all laws share it, changing between them makes no jump."""

    def __init__(self, limits: ArmLimits, rate: float) -> None:
        """`rate` in N m/s holds for torques without bias."""
        self._effort, self._rate = limits.effort.copy(), rate
        self._low, self._high = limits.range[:, 0] + RANGE_MARGIN_RAD, limits.range[:, 1] - RANGE_MARGIN_RAD
        self._spring = limits.effort / 4 / RANGE_MARGIN_RAD
        self._ramp = np.zeros_like(limits.effort)

    def step(self, tau: Array, state: ArmState, period: float) -> Array:
        """Return what to command (nv,) in N m for torques without bias. A new array."""
        told, longest = np.empty_like(tau), self._rate * period
        limit_torque(
            told, self._ramp, tau, state.q, state.bias, self._low, self._high, self._spring, self._effort, longest
        )
        return told


class JointLimit:
    """Limits joint positions in range and speed. Laws continue from q and dq (nv,), which were commanded last."""

    def __init__(self, limits: ArmLimits, q: Array) -> None:
        self._low, self._high = limits.range[:, 0].copy(), limits.range[:, 1].copy()
        self.velocity = limits.velocity.copy()
        self.q, self.dq = q.copy(), np.zeros_like(q)

    def step(self, q: Array, state: ArmState, period: float) -> Array:
        """Return what to command (nv,) in rad, a new array.

        ControlError when the arm does not follow; it is then commanded to stay where it is.
        """
        if limit_joints(self.q, self.dq, q, state.q, self._low, self._high, self.velocity, period):
            return self.q.copy()
        lag = np.abs(self.q - state.q).max()
        self.q[:], self.dq[:] = state.q, 0.0
        raise ControlError(f"a joint is {lag:.2f} rad away from where it was commanded to be; is the arm blocked?")


@compiled
def limit_torque(
    told: OutVector,
    ramp: OutVector,
    tau: Vector,
    q: Vector,
    bias: Vector,
    low: Vector,
    high: Vector,
    spring: Vector,
    effort: Vector,
    longest: float,
) -> None:
    """Let `ramp` follow tau by steps of at most `longest`; add the bias and what pushes joints back into range."""
    ramp += np.minimum(np.maximum(tau - ramp, -longest), longest)
    back = spring * (np.minimum(np.maximum(q, low), high) - q)
    told[:] = np.minimum(np.maximum(ramp + back + bias, -effort), effort)


@compiled
def limit_joints(
    told: OutVector,
    dq: OutVector,
    q: Vector,
    measured: Vector,
    low: Vector,
    high: Vector,
    velocity: Vector,
    period: float,
) -> bool:
    """Let `told`, with speeds dq, follow q within limits; return False, and do nothing, when the arm is too far."""
    lag = told - measured
    if (lag * lag).sum() > GREATEST_LAG_RAD * GREATEST_LAG_RAD:
        return False
    longest = velocity * period
    wanted = told + np.minimum(np.maximum(q - told, -longest), longest)
    inside = np.minimum(np.maximum(wanted, low), high)
    dq[:] = (inside - told) / period
    told[:] = inside
    return True
