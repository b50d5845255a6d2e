"""Taring: what a force sensor feels of nothing counts as 0 before a tool yields to what it feels.

What a sensor adds to each force and torque moves a tool that yields, and is a part of the force with which it presses.
At rest in free space it is all that is felt, so its mean is subtracted. A force that is greater than such an error may
be a contact, and stays.

An arm with torque sensors in its joints feels by these: what its momentum observer finds at rest, r, is what its model
of the weight of arm and tool, and its sensors, get wrong in this posture. The bias b that carries the arm is corrected
by the mean of n such measurements, step by step, so that nothing jumps: b' = b - r / (n + k). A correction that is no
more than the noise of this mean is taken back: a tool that nobody leads would creep.

A sensor in the wrist that drifts faster than its sheet allows is broken, or not warm yet: that is a reason to stop.
"""

from __future__ import annotations

from math import hypot, inf

import numpy as np

from skillc_runtime.control.measured import STILL_RAD_S, is_still
from skillc_runtime.control.momentum_observer import MEASURING, estimate_wrench
from skillc_runtime.devices.arm import Arm
from skillc_runtime.motion.pose import Array

REST_S = 0.9
"""How long an arm rests before it is tared, three time constants of the mean, in s."""

REST_AFTER_CONTACT_S = 1.8
"""The same where its wrist has felt a contact, six time constants: 50 N in the mean become 0.12 N."""

PATIENCE_S = 3.0
"""After this time without rest, in s, it is not tared."""

FORGOTTEN_S = 0.2
"""If it was not called for longer, what was begun before was given up."""

YIELDING_RAD_S = 2.0 * STILL_RAD_S
"""With the noise of its sensor, the joints of an arm that was taken off a contact move so fast now and then: what it
yields to with its hand is released still."""

GREATEST_N = 8.0
"""Less force on a tool at rest may be an error of the sensor: 4 N along each axis, as makers state."""

GREATEST_ERROR_N = 25.0
"""The same for what an arm feels by its torques: 3 % of its own weight, 0.2 kg of its tool, and its sensors."""

CAUTION = 3.0
"""The number k: of the first measurement a fourth is believed."""

LEAST_N, LEAST_N_M = 0.15, 0.02
"""Less is the noise of the mean, and is not subtracted."""

COARSE = 10.0
"""How many times as much that is in a mean which begins while the arm was moving."""


class Taring:
    """Tares the force sensor of an arm: before the tool is controlled for the first time, and once it has rested.

    impulse (1 + nv,): what the momentum observer of an arm that takes torques has added up, s and N m s; it changes.
    """

    def __init__(self, arm: Arm, drift_limit: float = inf) -> None:
        """drift_limit: N/s, of the force of the sensor."""
        self._arm, self._rested, self._is_tared = arm, 0.0, False
        self._drift_limit = drift_limit
        self._reason: str | None = None
        self._called = 0.0
        self._begun: float | None = None
        self.impulse: Array | None = None
        self._before, self._count = np.zeros(0), 0
        self._corrected: Array = np.zeros(0)
        """By how much the bias (nv,) was corrected in this rest, in N m."""

    def tare_first(self, dq: Array) -> None:
        """Tare an arm with joint speeds dq (nv,) in rad/s, if it rests and never was: its tool is controlled now."""
        if not self._is_tared and is_still(dq):
            self._take(COARSE)

    @property
    def force_drift(self) -> float:
        """How fast the force of the sensor was found to drift, in N/s; 0 without one."""
        rate = getattr(self._arm, "force_drift", None)  # An arm need not be derived from `Arm`.
        return 0.0 if rate is None else float(np.linalg.norm(rate))

    def take_fault(self) -> str | None:
        """Return once that the sensor drifts faster than it may; else None."""
        reason, self._reason = self._reason, None
        return reason

    @property
    def is_possible(self) -> bool:
        """Whether the arm feels forces that can be 0."""
        return self._arm.mean_wrench is not None or self.impulse is not None

    def tare(self, now: float, has_touched: bool = False) -> bool:
        """Tare at `now` s if the arm feels forces and has rested; return whether nothing is left to be waited for.

        has_touched: whether the tool was taken off something just before.
        """
        if not self.is_possible:
            return True
        if self._begun is None or now - self._called > FORGOTTEN_S:
            self._begun, self._rested, self._count = now, now, 0
        self._called = now
        forgets = has_touched and self._arm.mean_wrench is not None
        if not self._is_at_rest(forgets):
            self._rested, self._count = now, 0
        elif self.impulse is not None:
            self._correct(self.impulse)
        has_rested = now - self._rested >= (REST_AFTER_CONTACT_S if forgets else REST_S)
        if not has_rested and now - self._begun < PATIENCE_S:
            return False
        if has_rested:
            self._take(1.0)
            self._take_back_noise()
        self._begun, self._count = None, 0
        return True

    def _is_at_rest(self, yields: bool) -> bool:
        """Whether the joints are at rest, of an arm whose hand may yield to the noise of its sensor."""
        dq = self._arm.state().dq
        return bool(np.abs(dq).max() < YIELDING_RAD_S) if yields else is_still(dq)

    def _correct(self, impulse: Array) -> None:
        """Let the bias follow what was felt since the last call, at rest, unless it may be a contact."""
        if self._count > 0 and (passed_s := float(impulse[0] - self._before[0])) > 0.0:
            external, felt = (impulse[1:] - self._before[1:]) / passed_s, np.empty(6)
            estimate_wrench(felt, external, self._arm.state().jacobian, MEASURING)
            if hypot(*felt[:3]) < GREATEST_ERROR_N:
                correction = external / -(self._count + CAUTION)
                self._arm.correct_bias(correction)
                self._corrected += correction
        elif self._count == 0:
            self._corrected = np.zeros(len(impulse) - 1)
        self._before, self._count = impulse.copy(), self._count + 1

    def _take_back_noise(self) -> None:
        """Undo a correction that would be felt as less than the noise of the mean."""
        if self._count == 0 or self.impulse is None:
            return
        felt = np.empty(6)
        estimate_wrench(felt, self._corrected, self._arm.state().jacobian, MEASURING)
        if hypot(*felt[:3]) < LEAST_N and hypot(*felt[3:]) < LEAST_N_M:
            self._arm.correct_bias(-self._corrected)

    def _take(self, doubt: float) -> None:
        mean = self._arm.mean_wrench
        if mean is None:
            return
        force_n, torque_n_m = hypot(*mean[:3]), hypot(*mean[3:])
        if force_n < GREATEST_N and (force_n > doubt * LEAST_N or torque_n_m > doubt * LEAST_N_M):
            self._arm.tare()
            if self.force_drift > self._drift_limit:
                self._reason = (
                    f"the force sensor drifts by {self.force_drift:.2f} N/s, beyond the {self._drift_limit:g} N/s "
                    "that it may: it is not warm yet, or broken"
                )
        self._is_tared = True
