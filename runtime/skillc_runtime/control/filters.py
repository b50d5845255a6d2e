"""Filters that do not depend on the control rate: a first-order lag and a limit on the rate of change."""

from __future__ import annotations

from math import exp

import numpy as np

from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.pose import Array


@inlined
def lag_share(period: float, time_constant: float) -> float:
    """Return the share of the way to its target that a lag with a time constant covers in a period, both in s."""
    return 1 - exp(-period / time_constant) if time_constant > 0 else 1.0


@compiled
def step_lag(value: OutVector, target: Vector, share: float, grain: float) -> bool:
    """Let a value (n,) cover a share of the way to its target (n,); at a distance of `grain`, in its unit, all of it.

    Return whether it has arrived.
    """
    square = 0.0
    for i in range(value.size):
        square += (target[i] - value[i]) * (target[i] - value[i])
    arrived = square <= grain * grain
    for i in range(value.size):
        value[i] = target[i] if arrived else value[i] + share * (target[i] - value[i])
    return arrived


class Lag:
    """A first-order low-pass x <- x + (1 - exp(-h/T)) (target - x) with time constant T in s; 0 passes everything.

    `value` (n,), in any unit, is updated in place. It has `arrived` when it is closer to the target than `grain`.
    """

    def __init__(self, value: Array, time_constant: float, grain: float = 1e-6) -> None:
        self.value = value.copy()
        self._time_constant, self._grain = time_constant, grain
        self._period, self._share, self.arrived = -1.0, 1.0, True

    def step(self, target: Array, period: float) -> Array:
        """Follow the target for `period` s and return `value`."""
        if period != self._period:
            self._period = period
            self._share = lag_share(period, self._time_constant)
        self.arrived = step_lag(self.value, target, self._share, self._grain)
        return self.value


class RateLimit:
    """Follow a target with at most `rate` per s, for all or for each.

    `value` (n,), in any unit, is updated in place.
    """

    def __init__(self, value: Array, rate: float | Array) -> None:
        self.value = value.copy()
        self._rate = rate
        self._period, self._step = -1.0, np.empty_like(value)
        self._longest, self._least = np.zeros_like(value), np.zeros_like(value)

    def step(self, target: Array, period: float) -> Array:
        """Follow the target for `period` s and return `value`."""
        if period != self._period:
            self._period, self._longest[:], self._least[:] = period, self._rate * period, -self._rate * period
        np.subtract(target, self.value, out=self._step)
        np.minimum(self._step, self._longest, out=self._step)
        np.maximum(self._step, self._least, out=self._step)
        self.value += self._step
        return self.value
