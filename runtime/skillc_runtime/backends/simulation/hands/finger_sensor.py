"""The sensor of a gripper's opening, with the errors that its data sheet states."""

from __future__ import annotations

from math import isnan

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.noise import Noise, make_no_noise
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.arrays import Matrix, OutVector
from skillc_runtime.motion.numerics.compiled import inlined

LAST, NEXT, IS_EXACT, BIAS, PERIOD = range(5)
"""Entries of `Opening.values`: the last value in m, NaN before the first; s, from when on the next request measures; 1
without errors; a constant error in m; s, how long a value is valid."""


class Opening(msgspec.Struct, frozen=True):
    """What is measured of an opening.

    values (5,): see above; noise (n, 1): m, the next errors; used (1,): how many of them are used up.
    """

    values: OutVector
    noise: Matrix
    used: OutVector


@inlined
def measure(sensor: Opening, now: float, opening_m: float) -> bool:
    """Measure an opening at `now` in s, unless the last value is still valid; False if noise has to be drawn before."""
    values = sensor.values
    if values[IS_EXACT] != 0.0:
        values[LAST] = opening_m
    elif now >= values[NEXT]:
        if sensor.used[0] >= sensor.noise.shape[0]:
            return False
        error = sensor.noise[int(sensor.used[0]), 0]
        sensor.used[0] += 1.0
        values[LAST] = max(0.0, opening_m + values[BIAS] + error)
        values[NEXT] = now + values[PERIOD]
    return True


class FingerSensor:
    """Measures an opening once a period, at the first request in it, and returns that value until the period ends.

    greatest_error_m: of a sample, in m; `opening`: what compiled functions measure it with.
    """

    def __init__(
        self, period_s: float = 0.0, bias_m: float = 0.0, noise: Noise | None = None, greatest_error_m: float = 0.0
    ) -> None:
        """Begin without a value; exact without noise."""
        self.greatest_error_m = greatest_error_m
        self._noise = noise or make_no_noise(1)
        values = np.array([np.nan, -np.inf, float(noise is None), bias_m, period_s])
        self.opening = Opening(values, self._noise.rows, self._noise.used)

    @property
    def last_m(self) -> float | None:
        """The last value that was read, in m; None before the first."""
        last = float(self.opening.values[LAST])
        return None if isnan(last) else last

    def read(self, now: float, opening_m: float) -> float:
        """Return the measured opening in m, at least 0, of the true one at `now` in s."""
        if not measure(self.opening, now, opening_m):
            self._noise.draw()
            measure(self.opening, now, opening_m)
        return self.last_m or 0.0


def make_finger_sensor(gripper: GripperSpec, seed: int) -> FingerSensor:
    """Return the sensor of a gripper; its bias and noise follow from the seed."""
    rng = rng_for(gripper.individual, seed, 3)
    bias_m = gripper.opening_bias_m * rng.uniform(-1.0, 1.0)
    noise = Noise(np.array([gripper.opening_noise_m]), rng)
    exact = gripper.opening_bias_m == gripper.opening_noise_m == 0.0
    return FingerSensor(gripper.sensing_period_s, bias_m, None if exact else noise, gripper.opening_error_m)
