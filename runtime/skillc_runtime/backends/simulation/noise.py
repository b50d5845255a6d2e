"""Noise of sensors: normally distributed, independent between samples, reproducible by seed."""

from __future__ import annotations

from typing import Final

import numpy as np

from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array

BLOCK: Final = 1000
"""Rows drawn at once: a single draw costs as much as a hundred of them."""


class Noise:
    """Rows of noise with the standard deviations `deviation` (n,), which are drawn in blocks."""

    def __init__(self, deviation: Array, rng: np.random.Generator) -> None:
        self._deviation, self._rng = deviation, rng
        self._rows, self._next = np.empty((BLOCK, deviation.size)), BLOCK

    def row(self) -> Array:
        """Return the noise of one sample (n,), to be read at once."""
        if self._next == BLOCK:
            self._rng.standard_normal(out=self._rows)
            self._rows *= self._deviation
            self._next = 0
        row: Array = self._rows[self._next]
        self._next += 1
        return row


def make_joint_noise(arm: ArmSpec, seed: int) -> Noise | None:
    """Return the noise of an arm's joint speeds (nv,) rad/s; None if there is none."""
    deviation = np.full(arm.home.size, arm.joint_speed_noise)
    return Noise(deviation, rng_for(arm.individual, seed, 1)) if deviation.any() else None


def make_wrist_noise(arm: ArmSpec, seed: int) -> Noise | None:
    """Return the noise of an arm's wrist (9,): force N, torque N m, acceleration; None if there is none."""
    deviation = np.repeat([arm.force_noise_n, arm.torque_noise_n_m, 0.0], 3)
    return Noise(deviation, rng_for(arm.individual, seed, 2)) if deviation.any() else None
