"""Joint control: computed torque for torque-controlled arms; positions or speeds for arms with servos."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.limits import JointLimit, TorqueLimit
from skillc_runtime.devices.arm import ArmState, JointPosition, JointVelocity, Torque
from skillc_runtime.motion.joint import JointReference

BANDWIDTH = 20.0
"""Natural frequency of the computed-torque servo in rad/s; critically damped."""


class ComputedTorque:
    """tau = M (ddq_d + 2 w (dq_d - dq) + w^2 (q_d - q)) + bias, N m, for joints in rad. Arrays are reused."""

    def __init__(self, limit: TorqueLimit, joints: int) -> None:
        self._limit = limit
        self._acceleration, self._part, self._tau = (np.zeros(joints) for _ in range(3))

    def command(self, state: ArmState, reference: JointReference, period: float) -> Torque:
        """Return the joint torques for the next `period` s."""
        np.subtract(reference.dq, state.dq, out=self._acceleration)
        self._acceleration *= 2 * BANDWIDTH
        np.subtract(reference.q, state.q, out=self._part)
        self._part *= BANDWIDTH**2
        self._acceleration += self._part
        self._acceleration += reference.ddq
        np.dot(state.mass_matrix, self._acceleration, out=self._tau)
        return Torque(self._limit.step(self._tau, state, period))


class JointServo:
    """Commands the reference positions of joints to an arm with servos, as limited by `limit`."""

    def __init__(self, limit: JointLimit) -> None:
        self._limit = limit

    def command(self, state: ArmState, reference: JointReference, period: float) -> JointPosition | JointVelocity:
        """Return the joint positions or speeds for the next `period` s."""
        return self._limit.step(reference.q, state, period)
