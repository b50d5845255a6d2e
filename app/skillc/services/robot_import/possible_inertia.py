"""Makes moments of inertia that no body can have possible: none may exceed the sum of the two others."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array

MARGIN = 1e-6
"""Share of the largest moment by which the sum of the others exceeds it at least."""


def correct_inertia(spec: Any) -> dict[str, Array]:
    """Raise the moments that no body can have in a specification of MuJoCo.

    Return the moments (3,) in kg m^2 that were stated, the least first, of each such body, by its name.
    """
    stated = {}
    for body in spec.bodies:
        xx, yy, zz, xy, xz, yz = body.fullinertia.tolist()
        is_full = bool(np.isfinite(body.fullinertia).all())
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) if is_full else np.diag(body.inertia)
        if not body.explicitinertial or not inertia.any() or is_possible(inertia):
            continue
        stated[body.name] = np.linalg.eigvalsh(inertia)
        mended = nearest_possible(inertia)
        if is_full:
            body.fullinertia = mended[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        else:
            body.inertia = np.diag(mended)
    return stated


def restate_inertia(model: Any, stated: Mapping[str, Array]) -> Any:
    """Return a copy of a compiled model with the moments (3,) that were stated of some bodies, the least first."""
    before = copy(model)
    for name, moments in stated.items():
        body = model.body(name).id
        before.body_inertia[body, np.argsort(model.body_inertia[body])] = moments
    return before


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
