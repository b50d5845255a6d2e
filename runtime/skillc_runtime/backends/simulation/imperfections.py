"""Errors of measurements: each kind is one class, and a device applies all of its own, in order, to every sample."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import msgspec
import numpy as np

from skillc_runtime.motion.pose import Array


class Imperfection(Protocol):
    """One kind of error of a sensor, which may have a state of its own."""

    def distort(self, sample: Array) -> Array | None:
        """Return what becomes of a sample (n,), in the units of the device; None if it is lost."""
        ...


class Bias(msgspec.Struct, frozen=True):
    """A constant error (n,)."""

    error: Array

    def distort(self, sample: Array) -> Array:
        """Return the sample plus the error."""
        return sample + self.error


class WhiteNoise(msgspec.Struct, frozen=True):
    """Normally distributed errors with standard deviations (n,), independent between samples."""

    deviation: Array
    rng: np.random.Generator

    def distort(self, sample: Array) -> Array:
        """Return the sample plus noise."""
        return sample + self.deviation * self.rng.standard_normal(sample.size)


class Dropout(msgspec.Struct, frozen=True):
    """Loses this share of the samples, independently of each other."""

    share: float
    rng: np.random.Generator

    def distort(self, sample: Array) -> Array | None:
        """Return the sample, or None."""
        return None if self.rng.random() < self.share else sample


def distort(sample: Array, imperfections: Sequence[Imperfection]) -> Array | None:
    """Return what all imperfections, in order, make of a sample (n,); None if one of them loses it."""
    found: Array | None = sample
    for each in imperfections:
        if found is None:
            return None
        found = each.distort(found)
    return found
