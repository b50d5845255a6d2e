"""What sensors add to what they measure: normally distributed noise, independent between samples; bias and drift."""

from __future__ import annotations

from typing import Final

import numpy as np

from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.reality import NO_SIZES, Sizes
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array

BLOCK: Final = 1000
"""Rows drawn at once: a single draw costs as much as a hundred of them."""


class Noise:
    """Rows (n, m) of noise with standard deviations (m,), which are drawn in blocks.

    Their mean is `bias` (m,) at first, and changes by `drift` (m,) from row to row; 0 unless they are given.

    used (1,): how many of `rows` are used up; whoever uses the next one adds one, and calls `draw` if none is left.
    """

    def __init__(
        self, deviation: Array, rng: np.random.Generator, bias: Array | None = None, drift: Array | None = None
    ) -> None:
        self._deviation, self._rng = deviation, rng
        self._mean = np.zeros(deviation.size) if bias is None else bias.copy()
        self._drift = np.zeros(deviation.size) if drift is None else drift
        self.rows, self.used = np.zeros((BLOCK, deviation.size)), np.full(1, float(BLOCK))

    def draw(self) -> None:
        """Draw a block."""
        if self._deviation.any():
            self._rng.standard_normal(out=self.rows)
            self.rows *= self._deviation
        if self._mean.any() or self._drift.any():
            if not self._deviation.any():
                self.rows[:] = 0.0
            self.rows += self._mean + np.outer(np.arange(BLOCK), self._drift)
            self._mean += BLOCK * self._drift
        self.used[0] = 0.0


def make_joint_noise(arm: ArmSpec, seed: int) -> Noise:
    """Return the noise of an arm's joint speeds (nv,) rad/s."""
    return Noise(np.full(arm.home.size, arm.joint_speed_noise), rng_for(arm.individual, seed, 1))


def make_wrist_noise(arm: ArmSpec, seed: int, sizes: Sizes = NO_SIZES, step_s: float = 0.0) -> Noise:
    """Return the noise of an arm's wrist (9,): force N, torque N m, acceleration; a row for each step."""
    deviation = np.repeat([arm.force_noise_n, arm.torque_noise_n_m, 0.0], 3)
    bias, drift = np.zeros(9), np.zeros(9)
    bias[:3], bias[3:6] = sizes.get("forceBias", 0.0), sizes.get("torqueBias", 0.0)
    drift[:3] = sizes.get("forceDrift", 0.0)
    return Noise(deviation, rng_for(arm.individual, seed, 2), bias, drift * step_s)


def make_no_noise(size: int) -> Noise:
    """Return rows of zeros."""
    return Noise(np.zeros(size), np.random.default_rng(0))
