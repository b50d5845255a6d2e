"""Brings an arm to rest whose signals are wrong, with nothing that is measured after they became so.

The speeds at the stop follow from the last plausible ones and from the torques that were commanded since. Then
dq_v' = -R dq_v with tau = bias - R M dq_v: the torque takes the momentum of the arm, and what is left is gravity
compensation in the last plausible posture. Servos follow where the same speeds would take them, and take the tool off
what it presses on, in the posture that was commanded last.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Final, assert_never

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.limits import JointLimit
from skillc_runtime.control.supervision.signal_memory import FOUND, OF_WRIST, SignalMemory, find_speeds
from skillc_runtime.devices.arm import (
    Arm,
    ArmLimits,
    ArmState,
    Command,
    JointPosition,
    JointVelocity,
    Mode,
    NotOffered,
    Torque,
)
from skillc_runtime.motion.pose import Array

BRAKING_RATE: Final = 50.0
"""R in 1/s."""

RETREAT_M: Final = 0.02
RETREAT_S: Final = 0.25
"""How far a tool that presses on something goes back, and how long that takes."""

DAMPING: Final = 1e-3
"""Square of the damping of the inverse of the Jacobian, for the way back."""


class BlindStop:
    """Commands one arm until somebody has acknowledged that its signals are wrong.

    dq: (nv,) in rad/s, the speeds of the joints at the start.
    q: (nv,) in rad, where servos are commanded to be.
    holds: (nv,) in N m, the bias torques of the last plausible posture.
    mass: (nv, nv) in kg m^2, the mass matrix of the joints there.
    back: (nv,) in rad, by which servos go back then.
    period: s, of control.
    """

    def __init__(
        self, mode: Mode, dq: Array, q: Array, holds: Array, mass: Array, limits: ArmLimits, back: Array, period: float
    ) -> None:
        self._mode: Mode = mode
        self._dq, self._q, self._holds, self._mass = dq.copy(), q.copy(), holds.copy(), mass.copy()
        self._limits, self._back, self._period, self._passed_s = limits, back, period, 0.0

    @property
    def is_over(self) -> bool:
        """Whether nothing moves any more, as far as is known without sensors."""
        return self._passed_s > RETREAT_S + 5 / BRAKING_RATE

    def command(self) -> Command:
        """Return the command of the next control period."""
        period, limits = self._period, self._limits
        slower = np.exp(-BRAKING_RATE * period)
        match self._mode:
            case "torque":
                tau = self._holds - self._mass @ self._dq * (1 - slower) / period
                self._dq *= slower
                command: Command = Torque(np.clip(tau, -limits.effort, limits.effort))
            case "position":
                self._q += self._move(slower) * period
                command = JointPosition(np.clip(self._q, *limits.range.T))
            case "velocity":
                command = JointVelocity(np.clip(self._move(slower), -limits.velocity, limits.velocity))
            case never:
                assert_never(never)
        self._passed_s += period
        return command

    def _move(self, slower: float) -> Array:
        """Return the speeds (nv,) in rad/s of servos: as they become slower, and back with a smooth speed."""
        self._dq *= slower
        share = min(self._passed_s / RETREAT_S, 1.0)
        speeds: Array = self._dq + self._back * (6 * share * (1 - share) / RETREAT_S)
        return speeds


def find_way_back(J: Array, way: Array) -> Array:
    """Return by what joints (nv,) in rad the tool moves by a way (3,) in m in base, without turning.

    J (6, nv): [linear m; angular rad] per rad, base axes.
    """
    twist = np.concatenate([way, np.zeros(3)])
    joints: Array = J.T @ np.linalg.solve(J @ J.T + DAMPING * np.eye(6), twist)
    return joints


def predict_speeds(memory: SignalMemory, state: ArmState) -> Array:
    """Return the speeds (nv,) in rad/s of an arm that takes torques, from those before its signals became wrong."""
    dq = np.zeros_like(state.dq)
    find_speeds(dq, memory, state.mass_matrix.copy())
    return dq


def make_blind_stop(
    arm: Arm, signals: SignalMemory, task: ArmTask, state: ArmState, holds: Array, axis: Array | None
) -> BlindStop:
    """Return the stop of an arm, whose brakes engage if it takes torques and has some.

    holds (nv,): N m, what carries it where it was measured last; axis (3,): out of the surface that its tool presses
    on, in base, None if it presses on none. If only the wrist is wrong, servos stop from where they are, else from
    where they were commanded to be.
    """
    limit, mode, back = task.controllers.limit, arm.interface, np.zeros_like(state.q)
    if isinstance(limit, JointLimit):
        is_measured = signals.numbers[FOUND] in OF_WRIST
        q, dq = (state.q, state.dq) if is_measured else (limit.q, limit.dq)
        if axis is not None:
            back = find_way_back(task.kinematics.tool_at(q, state)[1], RETREAT_M * axis)
    else:
        q, dq = state.q, predict_speeds(signals, state)
        if hasattr(arm, "drop_brakes"):  # An arm need not be derived from `Arm`.
            with suppress(NotOffered):
                arm.drop_brakes()
    return BlindStop(mode, dq, q, holds, state.mass_matrix, task.limits, back, task.period)
