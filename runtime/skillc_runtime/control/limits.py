"""Limits of commands, whichever law they come from; one per arm, as the last stage before the arm."""

from __future__ import annotations

from math import exp
from typing import NoReturn

import numpy as np

from skillc_runtime.control.controller import ControlError
from skillc_runtime.devices.arm import ArmLimits, ArmState, JointPosition, JointVelocity, copy_command
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.pose import Array

RANGE_MARGIN, RANGE_MARGIN_SHARE = 0.05, 0.1
"""Within this distance of the end of its range, rad or m, a joint is pushed back, with a quarter of its effort at the
end; at most this share of its range."""

MAX_LAG_RAD = 0.2
"""An arm with servos that lags behind its command by more, as the norm over all joints, is blocked."""

RAMP, LOW, HIGH, SPRING, EFFORT = range(5)
"""Rows of `TorqueLimit.rows`, one value a joint.

RAMP N m: the torque so far, without bias; LOW, HIGH rad: beyond these joints are pushed back; SPRING N m/rad: with
this stiffness; EFFORT N m: the greatest torque.
"""

COMMANDED, SPEED, LEAST, MOST, FASTEST, PULL, LAG, EXPECTED, DRIVEN = range(9)
"""Rows of `JointLimit.rows`, one value a joint.

COMMANDED rad, SPEED rad/s: positions and speeds commanded last; LEAST, MOST rad, FASTEST rad/s: their limits. For
`SpeedLimit`: PULL 1/s and LAG s, as there; EXPECTED rad: expected positions; DRIVEN rad/s: the command.
"""


def range_margin(limits: Array) -> Array:
    """Return the distances (nv,) from the ends of ranges within which joints are pushed back.

    limits (nv, 2): rad or m.
    """
    return np.minimum(RANGE_MARGIN, RANGE_MARGIN_SHARE * (limits[:, 1] - limits[:, 0]))


class TorqueLimit:
    """Limits torques in rate, range and effort; all laws of an arm share it, so switching makes no jump.

    rows (5, nv): see above; rate: N m/s, of torques without bias. Joints (nv,).
    """

    def __init__(self, limits: ArmLimits, rate: float) -> None:
        margin = range_margin(limits.range)
        low, high = limits.range[:, 0] + margin, limits.range[:, 1] - margin
        spring = limits.effort / 4 / margin
        self.rows: Array = np.array([np.zeros_like(low), low, high, spring, limits.effort])
        self.rate = rate

    def step(self, tau: Array, state: ArmState, period: float) -> Array:
        """Return a new array (nv,) in N m, the command for torques tau without bias, for the next `period` s."""
        tau_out = np.empty_like(tau)
        limit_torque(tau_out, self.rows, tau, state.q, state.bias, self.rate * period)
        return tau_out


class JointLimit:
    """Limits joint positions in range and speed.

    q, dq (nv,): rad and rad/s, commanded last, from which laws continue. rows (9, nv): see above.
    """

    def __init__(self, limits: ArmLimits, q: Array) -> None:
        still = np.zeros_like(q)
        self.rows: Array = np.array([q, still, *limits.range.T, limits.velocity, still, still, q, still])
        self.q: Array = self.rows[COMMANDED]
        self.dq: Array = self.rows[SPEED]

    def step(self, q: Array, state: ArmState, period: float) -> JointPosition | JointVelocity:
        """Return the command towards q (nv,) in rad for the next `period` s, as a new array.

        ControlError if the arm does not follow; it then stays at its position.
        """
        return self.command_if_followed(limit_joints(self.rows, q, state.q, period), state)

    def command_if_followed(self, followed: bool, state: ArmState) -> JointPosition | JointVelocity:
        """Return the command of `limit_joints` if it found that the arm follows.

        ControlError as of `step` otherwise.
        """
        if not followed:
            self.give_up(state)
        return copy_command(self.live)

    def give_up(self, state: ArmState) -> NoReturn:
        """Stay at the position of an arm that does not follow, and raise ControlError."""
        lag = np.abs(self.q - state.q).max()
        self._stay(state)
        raise ControlError(f"a joint is {lag:.2f} rad away from where it was commanded to be; is the arm blocked?")

    def holding_joints(self, state: ArmState) -> Array:
        """Return the joints (nv,) in rad at which the arm is held if it must stop at once."""
        return self.q

    @property
    def live(self) -> JointPosition | JointVelocity:
        """The last command; its array changes with the next one."""
        return JointPosition(self.q)

    def _stay(self, state: ArmState) -> None:
        self.q[:], self.dq[:] = state.q, 0.0


class SpeedLimit(JointLimit):
    """The same for a velocity-controlled arm: dq = dq_c + pull (q_expected - q), so that errors do not accumulate.

    Joints are expected to follow with a lag dq_expected + q_expected = q_c, which is not an error. No command exceeds
    the speed limit of a joint or leaves its range within a period.
    q: (nv,) in rad.
    pull: 1/s.
    lag: s.
    """

    def __init__(self, limits: ArmLimits, q: Array, pull: float, lag: float) -> None:
        super().__init__(limits, q)
        self.rows[PULL], self.rows[LAG] = pull, lag

    def holding_joints(self, state: ArmState) -> Array:
        """Return the joints (nv,) in rad where the arm comes to rest.

        Others would be approached with growing effort.
        """
        self._stay(state)
        return self.q

    @property
    def live(self) -> JointPosition | JointVelocity:
        """The last command; its array changes with the next one."""
        return JointVelocity(self.rows[DRIVEN])

    def _stay(self, state: ArmState) -> None:
        self.q[:], self.dq[:] = state.q + self.rows[LAG] * state.dq, 0.0
        self.rows[EXPECTED] = state.q


@inlined
def _clamp(x: float, least: float, most: float) -> float:
    """Return x clamped between two limits; NaN is returned as it is."""
    if x < least:
        return least
    return most if x > most else x


@compiled
def limit_torque(tau_out: OutVector, rows: OutMatrix, tau: Vector, q: Vector, bias: Vector, longest: float) -> None:
    """Let the ramp follow tau by limited steps; add the bias, and push joints back into range.

    tau_out: (nv,) in N m; it is written.
    rows: (5, nv) in N m and rad, see `TorqueLimit`.
    tau: (nv,) in N m.
    q: (nv,) in rad.
    bias: (nv,) in N m.
    longest: N m, the greatest step.
    """
    for j in range(tau_out.size):
        rows[RAMP, j] += _clamp(tau[j] - rows[RAMP, j], -longest, longest)
        back = rows[SPRING, j] * (_clamp(q[j], rows[LOW, j], rows[HIGH, j]) - q[j])
        tau_out[j] = _clamp(rows[RAMP, j] + back + bias[j], -rows[EFFORT, j], rows[EFFORT, j])


@compiled
def limit_joints(rows: OutMatrix, q: Vector, measured: Vector, period: float) -> bool:
    """Let the command follow q within limits.

    Return False, and change nothing, if the joints are too far from the command.
    rows: (9, nv) in rad and rad/s, see `JointLimit`.
    q: (nv,) in rad.
    measured: (nv,) in rad, the joints.
    period: s.
    """
    square = 0.0
    for j in range(q.size):
        lag = rows[COMMANDED, j] - measured[j]
        square += lag * lag
    if square > MAX_LAG_RAD * MAX_LAG_RAD:
        return False
    for j in range(q.size):
        before, longest = rows[COMMANDED, j], rows[FASTEST, j] * period
        wanted = before + _clamp(q[j] - before, -longest, longest)
        rows[COMMANDED, j] = _clamp(wanted, rows[LEAST, j], rows[MOST, j])
        rows[SPEED, j] = (rows[COMMANDED, j] - before) / period
    if rows[PULL, 0] > 0.0:
        _update_speeds(rows, measured, period)
    return True


@inlined
def _update_speeds(rows: Array, measured: Array, period: float) -> None:
    """Compute the speeds that move the joints to the command within the period."""
    for j in range(measured.size):
        wanted, fastest = rows[SPEED, j] + rows[PULL, j] * (rows[EXPECTED, j] - measured[j]), rows[FASTEST, j]
        least, most = (rows[LEAST, j] - measured[j]) / period, (rows[MOST, j] - measured[j]) / period
        rows[DRIVEN, j] = _clamp(_clamp(wanted, -fastest, fastest), min(least, 0.0), max(most, 0.0))
        share = 1.0 - exp(-period / max(rows[LAG, j], 1e-9))
        rows[EXPECTED, j] += share * (rows[COMMANDED, j] - rows[SPEED, j] * period / 2 - rows[EXPECTED, j])
