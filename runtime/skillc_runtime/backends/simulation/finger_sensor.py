"""The sensor of a gripper's opening, with the errors that its data sheet states."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isnan

import numpy as np

from skillc_runtime.backends.simulation.imperfections import Bias, Imperfection, distort
from skillc_runtime.backends.simulation.noise import Noise
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array

LAST, NEXT, IS_EXACT = range(3)
"""Entries of `FingerSensor.values`: the last value in m, NaN before the first; s, from when on the next request
measures; 1 without errors."""


@dataclass(slots=True)
class FingerSensor:
    """Measures an opening once a period, at the first request in it, and returns that value until the period ends.

    imperfections: none for an exact sensor; greatest_error_m: of a sample, in m; values (3,): see above.
    """

    period_s: float = 0.0
    imperfections: tuple[Imperfection, ...] = ()
    greatest_error_m: float = 0.0
    values: Array = field(init=False)

    def __post_init__(self) -> None:
        """Begin without a value."""
        self.values = np.array([np.nan, -np.inf, float(not self.imperfections)])

    @property
    def last_m(self) -> float | None:
        """The last value that was read, in m; None before the first."""
        last = float(self.values[LAST])
        return None if isnan(last) else last

    def read(self, now: float, opening_m: float) -> float:
        """Return the measured opening in m, at least 0, of the true one at `now` in s."""
        if not self.imperfections:
            self.values[LAST] = opening_m
        elif now >= self.values[NEXT]:
            sample = distort(np.array([opening_m]), self.imperfections)
            if sample is not None:
                self.values[LAST] = max(0.0, float(sample[0]))
            self.values[NEXT] = now + self.period_s
        return self.last_m or 0.0


def make_finger_sensor(gripper: GripperSpec, seed: int) -> FingerSensor:
    """Return the sensor of a gripper; its bias and noise follow from the seed."""
    rng = rng_for(gripper.individual, seed, 3)
    bias = np.array([gripper.opening_bias_m * rng.uniform(-1.0, 1.0)])
    noise = Noise(np.array([gripper.opening_noise_m]), rng)
    exact = gripper.opening_bias_m == gripper.opening_noise_m == 0.0
    return FingerSensor(gripper.sensing_period_s, () if exact else (Bias(bias), noise), gripper.opening_error_m)
