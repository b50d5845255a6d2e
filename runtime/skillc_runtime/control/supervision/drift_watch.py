"""Watches how fast the zero of a force sensor drifts, so that it can follow between two tares.

Strain gauges drift as they warm up. Where a sensor is tared again in the same posture, after dt s, what it feels of
nothing is what has drifted meanwhile beyond what was expected, e in N. It is e/dt of the rate d that was not known yet.
As the mean of what is felt has a noise with the standard deviation s, that of e/dt is q = sqrt(2) s/dt, and the rate
follows by a Kalman filter for a constant that changes slowly, with the variance P:

    k = P / (P + q^2),   d' = d + k e/dt,   P' = (1 - k) P + r^2 dt

R. E. Kalman: A New Approach to Linear Filtering and Prediction Problems, Journal of Basic Engineering 82(1), 1960.
"""

from __future__ import annotations

from math import cos
from typing import Final

import numpy as np

from skillc_runtime.motion.pose import Array

NOISE_N: Final = 0.04
"""The standard deviation s of the mean by which a sensor is tared, in N."""

USUAL_N_S: Final = 0.05
"""The standard deviation of the rate of a sensor of which nothing is known, in N/s."""

CHANGE_N_S: Final = 0.0005
"""By how much the rate changes within a second: the number r, in N/s to the root of s."""

SHORTEST_S: Final = 2.0
"""Within less time a drift cannot be distinguished from noise."""

SAME_RAD: Final = 0.12
"""A hand that was turned by more, away from gravity, has another weight in a sensor with a wrong gain."""


class DriftWatch:
    """Estimates the rate (3,) in N/s with which each force of a sensor drifts, along its axes."""

    def __init__(self) -> None:
        self.rate = np.zeros(3)
        self._variance = USUAL_N_S**2
        self._at_s: float | None = None
        self._down: Array = np.zeros(3)

    def note(self, force: Array, down: Array, at_s: float) -> None:
        """Take what is felt of nothing at `at_s` s, before it is subtracted.

        force: (3,) in N, along the axes of the sensor, less the drift that was expected.
        down: the unit vector (3,) of gravity, along the same axes.
        """
        passed_s = None if self._at_s is None else at_s - self._at_s
        if passed_s is not None and 0.0 <= passed_s < SHORTEST_S:
            return  # what is subtracted now was felt, but for noise, a moment ago
        if passed_s is not None and passed_s > 0.0 and down @ self._down > cos(SAME_RAD):
            share = self._variance / (self._variance + 2.0 * (NOISE_N / passed_s) ** 2)
            self.rate = self.rate + share * force / passed_s
            self._variance = (1.0 - share) * self._variance + CHANGE_N_S**2 * passed_s
        self._at_s, self._down = at_s, down.copy()

    def forget_posture(self) -> None:
        """Compare nothing with what was felt before: another load is in the hand."""
        self._at_s = None
