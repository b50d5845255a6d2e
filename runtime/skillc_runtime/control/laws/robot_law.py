"""Stands for a compliant law on the robot's side, which gets the target of the tool and no joint commands."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.limits import JointLimit
from skillc_runtime.devices.arm import ArmState, Command, JointPosition
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference

AWAY_RAD = 0.01
"""Joints that have moved no further are where they were: a motion that is computed meanwhile still starts there."""


class RobotLaw:
    """The law of arms whose own controllers take the target of the tool: it commands no joints."""

    def __init__(self, limit: JointLimit, state: ArmState) -> None:
        self._limit, self._felt, self._tool = limit, np.zeros(6), state.tool

    @property
    def tool(self) -> Pose:
        """The measured tool centre point, in base."""
        return self._tool

    @property
    def contact_wrench(self) -> Array:
        """The measured wrench (6,) in N and N m, base axes; a copy."""
        return self._felt.copy()

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Do nothing but look: the robot holds its tool; q (nv,) in rad and dq in rad/s are not used."""
        self._look(state)

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Command:
        """Return the joints (nv,) in rad from which a motion of the joints continues; the robot is told the target.

        period: s.
        """
        self._look(state)
        return JointPosition(self._limit.q.copy())

    def _look(self, state: ArmState) -> None:
        self._felt[:], self._tool = state.wrench, state.tool
        if np.abs(state.q - self._limit.q).max() > AWAY_RAD:
            self._limit.q[:] = state.q
        self._limit.dq[:] = 0.0
