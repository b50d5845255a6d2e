"""A Cartesian impedance law on the robot's side, by topics: pose of the flange, stiffness and wrench along base axes.

tau = J^T (-K e - D J dq + W) + N (k (q_0 - q) - d dq) + bias, D = 2 sqrt(K m): plain, and not ours.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.pose import Array, Pose, log

MASS = np.array([8.0, 8.0, 8.0, 0.02, 0.02, 0.02])
"""What the damping assumes of the inertia at the flange: kg and kg m^2."""
FARTHEST_M, FARTHEST_RAD = 0.08, 0.4


class CartesianImpedance:
    """Holds the flange where it was at first, until a target comes."""

    def __init__(self, joints: int) -> None:
        self.target: Pose | None = None
        self.stiffness = np.array([800.0, 800.0, 800.0, 80.0, 80.0, 80.0])
        self.push = np.zeros(6)
        self._rest: Array | None = None
        self._axes = np.eye(3)

    def take_pose(self, message: Any) -> None:
        """Take a target pose."""
        at, turn = message.pose.position, message.pose.orientation
        self.target = Pose.of((at.x, at.y, at.z), (turn.w, turn.x, turn.y, turn.z))

    def take_stiffness(self, message: Any) -> None:
        """Take a stiffness, N/m and N m/rad."""
        self.stiffness = np.maximum(_six(message.wrench), 0.0)

    def take_wrench(self, message: Any) -> None:
        """Take the wrench to exert on the environment, N and N m."""
        self.push = _six(message.wrench)

    def take_posture(self, q: Array, flange: Pose) -> None:
        """Take a posture (nv,) in rad, with the flange in it: a redundant arm goes there as a whole."""
        self._rest, self.target = q, flange

    def torques(self, state: ArmState, flange: Pose) -> Array:
        """Return the torques (nv,) in N m; `flange` is in the base."""
        if self.target is None or self._rest is None:
            self.target, self._rest = flange, state.q.copy()
        way = flange.position - state.tool.position
        J = state.jacobian.copy()
        J[:3] += np.cross(J[3:].T, way).T
        error = np.concatenate(
            [
                _clamp(flange.position - self.target.position, FARTHEST_M),
                _clamp(log(flange.rotation @ self.target.rotation.T), FARTHEST_RAD),
            ]
        )
        damping = np.maximum(2 * np.sqrt(self.stiffness * MASS), [60.0, 60.0, 60.0, 2.0, 2.0, 2.0])
        wrench = -self.stiffness * error - damping * (J @ state.dq) + self.push
        posture = 60.0 * (self._rest - state.q) - 14.0 * state.dq
        kept = posture - J.T @ np.linalg.solve(J @ J.T + 1e-6 * np.eye(6), J @ posture)
        tau: Array = J.T @ wrench + kept + state.bias
        return tau


def _six(wrench: Any) -> Array:
    return np.array([wrench.force.x, wrench.force.y, wrench.force.z, wrench.torque.x, wrench.torque.y, wrench.torque.z])


def _clamp(x: Array, longest: float) -> Array:
    length = float(np.linalg.norm(x))
    return x if length <= longest else x * (longest / length)
