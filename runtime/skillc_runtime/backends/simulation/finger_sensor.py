"""The sensor of a gripper's opening, with the errors that its data sheet states."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from skillc_runtime.backends.simulation.imperfections import Bias, Imperfection, WhiteNoise, distort
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.rng import rng_for


@dataclass(slots=True)
class FingerSensor:
    """Measures an opening once a period, at the first request in it, and returns that value until the period ends.

    imperfections: none for an exact sensor; greatest_error_m: of a sample, in m. last_m: the
    last value that was read, in m; None before the first.
    """

    period_s: float = 0.0
    imperfections: tuple[Imperfection, ...] = ()
    greatest_error_m: float = 0.0
    last_m: float | None = field(default=None, init=False)
    _next: float = field(default=-np.inf, init=False)

    def read(self, now: float, opening_m: float) -> float:
        """Return the measured opening in m, at least 0, of the true one at `now` in s."""
        if not self.imperfections:
            self.last_m = opening_m
        elif now >= self._next:
            sample = distort(np.array([opening_m]), self.imperfections)
            self.last_m = self.last_m if sample is None else max(0.0, float(sample[0]))
            self._next = now + self.period_s
        return self.last_m or 0.0


def make_finger_sensor(gripper: GripperSpec, seed: int) -> FingerSensor:
    """Return the sensor of a gripper; its bias and noise follow from the seed."""
    rng = rng_for(gripper.individual, seed, 3)
    bias = np.array([gripper.opening_bias_m * rng.uniform(-1.0, 1.0)])
    noise = WhiteNoise(np.array([gripper.opening_noise_m]), rng)
    exact = gripper.opening_bias_m == gripper.opening_noise_m == 0.0
    return FingerSensor(gripper.sensing_period_s, () if exact else (Bias(bias), noise), gripper.opening_error_m)
