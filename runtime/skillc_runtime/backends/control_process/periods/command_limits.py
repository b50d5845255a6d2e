"""The last limits of commands to a device, of whichever law: range, speed, acceleration, jerk and torque."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from skillc_runtime.control.controller import ControlError
from skillc_runtime.devices.arm import ArmLimits, Mode
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.pose import Array

FASTEST_SHARE, BRAKING = 0.99, 0.6
"""Shares of the limits of speed, and of acceleration and jerk when they brake, that are used."""

UNLIMITED = 1e9
"""Stands for no limit, in any unit: arithmetic with it yields numbers."""

LAST, LAST_SPEED, LAST_ACCELERATION, WANTED, LEAST, MOST, SPEED, ACCELERATION, JERK, EFFORT, RATE = range(11)
"""Rows of `CommandLimits.rows`, one value a joint: what was commanded last, what was wanted then, and the limits."""


@dataclass(frozen=True, slots=True)
class RateLimits:
    """How fast commands may change, (nv,): jerk in rad/s^3 of positions and speeds, rate in N m/s of torques."""

    jerk: Array
    torque_rate: Array


@dataclass(frozen=True, slots=True)
class Margins:
    """How far commands and measurements may be from limits.

    soft_start_s: time after taking control in which the limits of speed and torque grow from a tenth to all of them.
    lead: a limited command may be this far from what a law wants, in rad or in m; then the arm is stopped. overspeed:
    an arm is stopped that moves faster than this share of the limit of a joint's speed.
    """

    soft_start_s: float = 0.5
    lead: float = 0.05
    overspeed: float = 1.1


USUAL_MARGINS = Margins()


class CommandLimits:
    """Limits the commands of one arm, one after another, a period in s apart."""

    def __init__(self, limits: ArmLimits, rates: RateLimits, period_s: float, margins: Margins = USUAL_MARGINS) -> None:
        self._limits, self._margins, self._period, self._since = limits, margins, period_s, 0.0
        still = np.zeros_like(limits.velocity)
        most = (limits.acceleration, rates.jerk, limits.effort, rates.torque_rate)
        finite = (np.minimum(each, UNLIMITED) for each in most)
        self.rows: Array = np.array([still, still, still, still, *limits.range.T, limits.velocity, *finite])

    def begin(self, mode: Mode, target: Array, bias: Array) -> None:
        """Start from rest, with the device's servos at `target` (nv,) in rad, or torques of `bias` (nv,) in N m."""
        self._since = 0.0
        self.continue_from(mode, target, bias)

    def continue_from(self, mode: Mode, target: Array, bias: Array) -> None:
        """Go on from elsewhere, as `begin`, but not slowly: something else has moved the arm meanwhile."""
        self.rows[LAST] = self.rows[WANTED] = bias if mode == "torque" else target if mode == "position" else 0.0
        self.rows[LAST_SPEED] = self.rows[LAST_ACCELERATION] = 0.0

    def check_measured(self, q: Array, dq: Array) -> str | None:
        """Return which joint is beyond its range or its speed, (nv,) in rad and rad/s; None if none is."""
        limits = self._limits
        fast = np.abs(dq) - self._margins.overspeed * limits.velocity
        if fast.max() > 0.0:
            joint = int(fast.argmax())
            return f"joint {joint + 1} moves with {abs(dq[joint]):.2f} rad/s, beyond its {limits.velocity[joint]:.2f}"
        beyond = np.maximum(limits.range[:, 0] - q, q - limits.range[:, 1])
        if beyond.max() > 0.0:
            joint = int(beyond.argmax())
            return f"joint {joint + 1} is {beyond[joint]:.3f} rad beyond the end of its range"
        return None

    def apply(self, mode: Mode, values: OutVector, bias: Array) -> None:
        """Limit the values (nv,) of a command: N m, rad or rad/s; `bias` (nv,) in N m carries the arm.

        ControlError if it is far beyond limits; the values are then those of the best command within them.
        """
        self._since += self._period
        share = min(1.0, 0.1 + self._since / self._margins.soft_start_s)
        if mode == "torque":
            limit_torques(self.rows, values, bias, share, self._period)
            return
        far = limit_motion(self.rows, values, mode == "velocity", share, self._period)
        if far > self._margins.lead:
            raise ControlError(f"what is commanded is {far:.2f} rad or m ahead of what the limits of the joints allow")


@compiled
def limit_torques(rows: OutMatrix, values: OutVector, bias: Vector, share: float, period: float) -> None:
    """Limit torques (nv,) in N m in rate, in what they exceed `bias` by, to a share of the effort, and in effort."""
    for j in range(values.size):
        longest, most = rows[RATE, j] * period, share * rows[EFFORT, j]
        tau = min(max(values[j], bias[j] - most), bias[j] + most)
        tau = min(max(tau, rows[LAST, j] - longest), rows[LAST, j] + longest)
        values[j] = rows[LAST, j] = min(max(tau, -rows[EFFORT, j]), rows[EFFORT, j])


@compiled
def limit_motion(rows: OutMatrix, values: OutVector, speeds: bool, share: float, period: float) -> float:
    """Limit positions (nv,) in rad, or speeds in rad/s; return the greatest distance in rad from what was wanted.

    A command that lags behind catches up no faster than it can brake, and so it comes to the end of a range:
    |v| <= sqrt(2 a e), e being what it lags by, or the way to the end. So it is with the change of speed that is left:
    |a| <= sqrt(2 j dv). Both brake with a share of a and of the jerk j, the rest being for what periods round.
    """
    farthest = 0.0
    for j in range(values.size):
        most, jerk, speed = rows[ACCELERATION, j], rows[JERK, j], rows[LAST_SPEED, j]
        wanted = values[j]
        if not speeds:
            away = rows[WANTED, j] - rows[LAST, j]
            catch = min(sqrt(2.0 * BRAKING * most * abs(away)), abs(away) / period) * share
            wanted = (values[j] - rows[WANTED, j]) / period + (catch if away > 0.0 else -catch)
            rows[WANTED, j] = values[j]
            down, up = max(rows[LAST, j] - rows[LEAST, j], 0.0), max(rows[MOST, j] - rows[LAST, j], 0.0)
            wanted = min(max(wanted, -sqrt(2.0 * BRAKING * most * down)), sqrt(2.0 * BRAKING * most * up))
        fastest = FASTEST_SHARE * share * rows[SPEED, j]
        wanted = min(max(wanted, -fastest), fastest)
        most = min(most, sqrt(2.0 * BRAKING * jerk * abs(wanted - speed)))
        faster = min(max((wanted - speed) / period, -most), most)
        before = rows[LAST_ACCELERATION, j]
        faster = min(max(faster, before - jerk * period), before + jerk * period)
        speed = speed + faster * period
        if speeds:
            farthest = max(farthest, abs(values[j] - speed) * period)
            values[j] = speed
        else:
            after = min(max(rows[LAST, j] + speed * period, rows[LEAST, j]), rows[MOST, j])
            farthest = max(farthest, abs(values[j] - after))
            speed = (after - rows[LAST, j]) / period
            values[j] = rows[LAST, j] = after
        rows[LAST_ACCELERATION, j] = (speed - rows[LAST_SPEED, j]) / period
        rows[LAST_SPEED, j] = speed
    return farthest
