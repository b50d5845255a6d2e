"""Brakes in the joints of a simulated arm: some time after the power is off, friction holds each joint.

Friction at a joint is at most F, and until it slips it takes what moves the arm and pulls it back to where it stuck:
torque = -M (a dq + b (q - q_s) / h) / h, clipped to F; where it is clipped, q_s follows q. M: mass matrix, h: step.
"""

from __future__ import annotations

from math import inf
from typing import Final

import numpy as np

from skillc_runtime.backends.simulation.arms.motors import Joints
from skillc_runtime.motion.pose import Array

TAKEN_SHARE, BACK_SHARE = 0.3, 0.02
"""a and b: what share of the speed is taken in a step, and of the way; without oscillation, as a^2 > 4 b."""

OFF: Final = inf


class Brakes:
    """The brakes of an arm that takes torques, each as strong as the motor of its joint.

    joints: of the arm; delay_s: from the command until they act; step_s: of the simulation.
    """

    def __init__(self, joints: Joints, delay_s: float, step_s: float) -> None:
        self._joints, self._delay_s, self._step_s = joints, delay_s, step_s
        self._due_s, self._stuck = OFF, joints.q.copy()

    @property
    def is_off(self) -> bool:
        """Whether the brakes are released."""
        return self._due_s == OFF

    def engage(self, now: float) -> None:
        """Let them act after their delay, from `now` s on."""
        if self.is_off:
            self._due_s = now + self._delay_s

    def release(self) -> None:
        """Release them at once."""
        self._due_s = OFF

    def act(self, now: float) -> bool:
        """Whether the power is off and they act at `now` s."""
        return now >= self._due_s - self._step_s / 2

    def step(self, now: float) -> None:
        """Let friction act instead of the motors, for one step from `now` s on."""
        joints, step_s = self._joints, self._step_s
        if not self.act(now):
            self._stuck[:] = joints.q
            return
        pull = TAKEN_SHARE * joints.dq + BACK_SHARE * (joints.q - self._stuck) / step_s
        torque: Array = -(joints.mass_matrix @ pull) / step_s
        slips = np.abs(torque) > joints.effort
        self._stuck[slips] = joints.q[slips]
        np.clip(torque, -joints.effort, joints.effort, out=joints.control)
