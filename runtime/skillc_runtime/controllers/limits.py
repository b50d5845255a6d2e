"""The last word before a command reaches an arm: what the arm can take, whichever law asks. One of them per arm."""

from __future__ import annotations

import numpy as np

from skillc_runtime.controllers.controller import ControlError
from skillc_runtime.controllers.filters import RateLimit
from skillc_runtime.motion.pose import Array
from skillc_runtime.robots.arm import ArmLimits, ArmState

RANGE_MARGIN_RAD = 0.05
"""Within this distance of the end of its range a joint is pushed back, at the end with a quarter of its effort."""

GREATEST_LAG_RAD = 0.2
"""A position-controlled arm that lags behind its command by more, over all joints, is stuck."""


class TorqueLimit:
    """Limits torques in rate, range and effort; since all laws share it, changing between them makes no jump."""

    def __init__(self, limits: ArmLimits, rate: float) -> None:
        self._most, self._least = limits.effort.copy(), -limits.effort
        self._ramp = RateLimit(np.zeros_like(limits.effort), rate)
        self._low, self._high = limits.range[:, 0] + RANGE_MARGIN_RAD, limits.range[:, 1] - RANGE_MARGIN_RAD
        self._spring = limits.effort / 4 / RANGE_MARGIN_RAD
        self._tau, self._inside = np.empty_like(limits.effort), np.empty_like(limits.effort)

    def step(self, tau: Array, state: ArmState, period: float) -> Array:
        """Return what to command (nv,) in N m for torques without bias; `rate` in N m/s holds for them. A new array."""
        np.maximum(state.q, self._low, out=self._inside)
        np.minimum(self._inside, self._high, out=self._inside)
        np.subtract(self._inside, state.q, out=self._tau)
        self._tau *= self._spring
        self._tau += self._ramp.step(tau, period)
        self._tau += state.bias
        np.minimum(self._tau, self._most, out=self._tau)
        return np.maximum(self._tau, self._least)


class JointLimit:
    """Limits joint positions in range and speed. `q` (nv,) is what was commanded last; laws continue from there."""

    def __init__(self, limits: ArmLimits, q: Array) -> None:
        self._low, self._high = limits.range[:, 0].copy(), limits.range[:, 1].copy()
        self._ramp = RateLimit(q, limits.velocity)
        self._velocity, self._share = limits.velocity.copy(), np.empty_like(q)
        self._lag = np.empty_like(q)
        self.q = self._ramp.value

    def step(self, q: Array, state: ArmState, period: float) -> Array:
        """Return what to command (nv,) in rad, a new array.

        ControlError when the arm does not follow; it is then commanded to stay where it is.
        """
        lag = np.subtract(self.q, state.q, out=self._lag)
        if lag.dot(lag) > GREATEST_LAG_RAD**2:
            self.q[:] = state.q
            raise ControlError(
                f"a joint is {np.abs(lag).max():.2f} rad away from where it was commanded to be; is the arm blocked?"
            )
        self._ramp.step(q, period)
        np.maximum(self.q, self._low, out=self.q)
        np.minimum(self.q, self._high, out=self.q)
        return self.q.copy()

    def slowed(self, velocity: Array) -> Array:
        """Scale joint velocities (nv,) in place so that none exceeds its limit; the direction stays."""
        share = np.divide(velocity, self._velocity, out=self._share)
        if share.dot(share) > 1:
            velocity /= max(1.0, float(np.abs(share).max()))
        return velocity
