"""Makes moments of inertia that no body can have possible: none may exceed the sum of the two others."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.pose import Array

MARGIN = 1e-6
"""Share of the largest moment by which the sum of the others exceeds it at least."""


def is_possible(inertia: Array) -> bool:
    """Whether an inertia (3, 3) in kg m^2 about the centre of mass is that of some body."""
    moments = np.linalg.eigvalsh(inertia)
    return bool(moments[0] > 0.0 and moments[0] + moments[1] >= (1 + MARGIN / 2) * moments[2])


def nearest_possible(inertia: Array) -> Array:
    """Return the inertia (3, 3) in kg m^2 with the same axes and largest moment, and the others raised equally."""
    moments, axes = np.linalg.eigh(inertia)
    lost = (1 + MARGIN) * moments[2] - moments[0] - moments[1]
    moments[:2] += max(lost, 0.0) / 2
    if moments[0] <= 0.0:
        moments[:] = [max(moments[0], MARGIN * moments[2]), moments[2], moments[2]]
    return np.asarray(axes * moments @ axes.T)
