"""What a torque-controlled arm without a sensor at its wrist feels: the momentum that its torques do not explain.

r = (M (dq_1 - dq_0) - int (tau - bias) dt) / T over short windows, low-passed; W = (J J^T + lam^2 I)^-1 J r.
De Luca et al. 2006, with the mass matrix taken as constant within a window.
"""

from __future__ import annotations

from math import exp

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.robots.arm import ArmState

WINDOW_S = 0.01
"""How long momentum is gathered before it is compared."""

LAG_S = 0.01
"""Time constant of the low-pass on the comparison."""

DAMPING = 1e-3
"""lam^2: near a singularity a force along the lost direction is felt less, instead of noise being felt as force."""


class Resistance:
    """Estimates the wrench of the environment on the tool from what one arm was told and how it moved."""

    def __init__(self, state: ArmState) -> None:
        joints = state.q.size
        self._tau, self._bias, self._impulse = state.bias.copy(), state.bias.copy(), np.zeros(joints)
        self._dq, self._torque, self._net = state.dq.copy(), np.zeros(joints), np.zeros(joints)
        self._elapsed = 0.0

    def told(self, tau: Array) -> None:
        """Take in the joint torques (nv,) in N m, bias included, that hold for the next period."""
        self._tau[:] = tau

    def step(self, state: ArmState, period: float) -> None:
        """Take in what was measured at the end of a period of `period` s."""
        np.subtract(self._tau, self._bias, out=self._net)
        self._net *= period
        self._impulse += self._net
        self._bias[:] = state.bias
        self._elapsed += period
        if self._elapsed > WINDOW_S - period / 2:
            self._compare(state)

    def wrench(self, state: ArmState) -> Array:
        """Return the wrench (6,) in N and N m, base axes, at the tool."""
        J = state.jacobian
        return np.asarray(np.linalg.solve(J @ J.T + DAMPING * np.eye(6), J @ self._torque))

    def _compare(self, state: ArmState) -> None:
        found = (state.mass_matrix @ (state.dq - self._dq) - self._impulse) / self._elapsed
        self._torque += (1 - exp(-self._elapsed / LAG_S)) * (found - self._torque)
        self._dq[:], self._impulse[:], self._elapsed = state.dq, 0.0, 0.0
