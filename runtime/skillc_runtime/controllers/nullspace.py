"""Keeping the posture of a redundant arm without moving its tool.

tau_0 = k (q_n - q) - d dq;  (J J^T + lam^2 I) y = J tau_0;  tau_null = tau_0 - J^T y
A share lam^2 / (s_i^2 + lam^2) of tau_0 reaches the tool along singular direction i, so lam stays tiny until the arm
comes near a singularity, where s_i falls and the solution would grow.
"""

from __future__ import annotations

from math import prod, sqrt

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.robots.arm import ArmState

REGULARISATION = 1e-6
"""lam^2 away from singularities."""

SINGULAR_BELOW, SINGULAR_REGULARISATION = 5e-3, 1e-2
"""Manipulability sqrt(det J J^T) below which lam^2 rises, and what it rises to."""


class Nullspace:
    """Pulls towards `rest` (nv,) with `stiffness` N m/rad, damped as for unit inertia. Arrays are reused."""

    def __init__(self, stiffness: float, joints: int) -> None:
        self.rest = np.zeros(joints)
        self.manipulability = np.inf
        self._stiffness, self._damping = stiffness, 2 * sqrt(stiffness)
        self._tau, self._part = np.zeros(joints), np.zeros(joints)
        self._gram, self._wrench, self._solution = np.zeros((6, 6)), np.zeros(6), np.zeros(6)
        self._diagonal = self._gram.ravel()[::7]

    def torque(self, state: ArmState) -> Array:
        """Return tau_null (nv,) in N m."""
        np.subtract(self.rest, state.q, out=self._tau)
        self._tau *= self._stiffness
        np.multiply(state.dq, self._damping, out=self._part)
        self._tau -= self._part
        J = state.jacobian
        np.dot(J, J.T, out=self._gram)
        self._diagonal += self.regularisation
        mujoco.mju_cholFactor(self._gram, 0.0)
        self.manipulability = prod(self._diagonal.tolist())
        np.dot(J, self._tau, out=self._wrench)
        mujoco.mju_cholSolve(self._solution, self._gram, self._wrench)
        np.dot(self._solution, J, out=self._part)
        self._tau -= self._part
        return self._tau

    @property
    def regularisation(self) -> float:
        """lam^2 for the manipulability seen last."""
        near = max(0.0, 1 - self.manipulability / SINGULAR_BELOW)
        return REGULARISATION + SINGULAR_REGULARISATION * near * near
