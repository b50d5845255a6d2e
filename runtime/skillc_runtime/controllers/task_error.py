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
    it scales all three, since a released axis follows no reference. measured (6,): what the law measures, unscaled.
    """

    def __init__(self, stiffness: Array) -> None:
        self._softness = 10 / stiffness
        self.axes, self.held = np.eye(3), np.zeros(6)
        in_base, in_frame = np.zeros((4, 6)), np.zeros((4, 6))
        self._error, self._twist, self._acceleration, self._measured = in_base
        self._way, self._rotation_vector = self._error[:3], self._error[3:]
        self.error, self.twist, self.acceleration, self.measured = in_frame
        self._scaled, self._error_parts = in_frame[:3], (self.error[:3], self.error[3:])
        self._rows_in_base, self._rows_in_frame = in_base.reshape(8, 3), in_frame.reshape(8, 3)
        self._turn, self._quaternion = np.empty((3, 3)), np.empty(4)
        self._flat_turn = self._turn.ravel()

    def update(self, tool: Pose, reference: Reference, compliance: Compliance, measured: Array) -> None:
        """Compute all of it for a tool pose and a measured 6-vector in base; both halves of it turn like vectors."""
        np.multiply(compliance.stiffness, self._softness, out=self.held)
        np.minimum(self.held, 1.0, out=self.held)
        np.dot(reference.pose.rotation, compliance.frame, out=self.axes)
        np.subtract(tool.position, reference.pose.position, out=self._way)
        np.dot(tool.rotation, reference.pose.rotation.T, out=self._turn)
        mujoco.mju_mat2Quat(self._quaternion, self._flat_turn)
        mujoco.mju_quat2Vel(self._rotation_vector, self._quaternion, 1.0)
        self._twist[:], self._acceleration[:] = reference.twist, reference.acceleration
        self._measured[:] = measured
        np.dot(self._rows_in_base, self.axes, out=self._rows_in_frame)
        self._scaled *= self.held
        if self.error.dot(self.error) > CLAMP_M**2:
            _clamp(self._error_parts[0], CLAMP_M)
            _clamp(self._error_parts[1], CLAMP_RAD)


def _clamp(vector: Array, longest: float) -> None:
    """Shorten a vector in place to a length."""
    square = float(vector.dot(vector))
    if square > longest * longest:
        vector *= longest / sqrt(square)
