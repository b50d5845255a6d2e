"""The error of the tool in the compliance frame, as all laws need it."""

from __future__ import annotations

from math import sqrt

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference

CLAMP_M, CLAMP_RAD = 0.05, 0.3
"""Greatest error that a spring sees, so that a wrong goal cannot produce an unbounded force."""


class TaskError:
    """Error and feed-forward in the compliance frame C. `stiffness`: of axes nobody released. Arrays are reused.

    axes (3, 3): C in base. error (6,): tool minus reference, m and rad, clamped in length. twist, acceleration (6,):
    of the reference. held (6,): 1 for a stiff axis, 0 for a released one, between below a tenth of the full stiffness;
    it scales all three, since a released axis follows no reference.
    """

    def __init__(self, stiffness: Array) -> None:
        self._softness = 10 / stiffness
        self.axes = np.eye(3)
        self.error, self.twist, self.acceleration, self.held = (np.zeros(6) for _ in range(4))
        self._turn, self._in_base = np.empty((3, 3)), np.empty(6)
        self._quaternion, self._rotation_vector = np.empty(4), self._in_base[3:]
        self._flat_turn, self._way = self._turn.ravel(), self._in_base[:3]
        self._error_parts = self.error[:3], self.error[3:]

    def update(self, tool: Pose, reference: Reference, compliance: Compliance) -> None:
        """Compute all of it for a tool pose in base."""
        np.multiply(compliance.stiffness, self._softness, out=self.held)
        np.minimum(self.held, 1.0, out=self.held)
        np.matmul(reference.pose.rotation, compliance.frame, out=self.axes)
        np.subtract(tool.position, reference.pose.position, out=self._way)
        np.matmul(tool.rotation, reference.pose.rotation.T, out=self._turn)
        mujoco.mju_mat2Quat(self._quaternion, self._flat_turn)
        mujoco.mju_quat2Vel(self._rotation_vector, self._quaternion, 1.0)
        self._into(self._in_base, self.error)
        _clamp(self._error_parts[0], CLAMP_M)
        _clamp(self._error_parts[1], CLAMP_RAD)
        self._into(reference.twist, self.twist)
        self._into(reference.acceleration, self.acceleration)

    def _into(self, in_base: Array, out: Array) -> None:
        """Write a 6-vector of base axes in the axes of C, scaled by `held`."""
        np.matmul(in_base.reshape(2, 3), self.axes, out=out.reshape(2, 3))
        out *= self.held


def _clamp(vector: Array, longest: float) -> None:
    """Shorten a vector in place to a length."""
    square = float(vector @ vector)
    if square > longest * longest:
        vector *= longest / sqrt(square)
