"""How far round geoms are apart at least: capsules, spheres and cylinders, of which boxes around them say little."""

from __future__ import annotations

from math import sqrt
from typing import Any, Final

import mujoco
import numpy as np

from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.pose import Array

ANGULAR, CAPSULE, CYLINDER = 0.0, 1.0, 2.0
"""Shapes: anything that is as far as its box is known; a capsule or a sphere; a cylinder."""

SHAPE: Final = 7
"""The column of the shape of a geom."""

_KINDS = mujoco.mjtGeom
_SHAPES = {_KINDS.mjGEOM_CAPSULE: CAPSULE, _KINDS.mjGEOM_SPHERE: CAPSULE, _KINDS.mjGEOM_CYLINDER: CYLINDER}


def find_shapes(model: Any) -> Array:
    """Return the shapes (ngeom,) of all geoms."""
    return np.array([_SHAPES.get(_KINDS(kind), ANGULAR) for kind in model.geom_type.tolist()])


@inlined
def half_length(boxes: Array, geom: int) -> float:
    """Return half the length in m of the axis of a round geom: of a capsule up to the middles of its ends."""
    return float(boxes[geom, 5] - boxes[geom, 3] if boxes[geom, SHAPE] == CAPSULE else boxes[geom, 5])


@inlined
def reach_along(boxes: Array, geom: int, cosine: float) -> float:
    """Return how far a round geom reaches from its middle in m, in a direction at an angle to its axis."""
    ends, radius = abs(cosine) * half_length(boxes, geom), boxes[geom, 3]
    return float(
        ends + radius if boxes[geom, SHAPE] == CAPSULE else ends + radius * sqrt(max(1.0 - cosine * cosine, 0.0))
    )


@inlined
def within(value: float, most: float) -> float:
    """Return the number nearest to a value between `-most` and `most`."""
    return min(max(value, -most), most)


@inlined
def gap_between_axes(boxes: Array, centres: Array, axes: Array, one: int, other: int) -> float:
    """Return how far two round geoms are apart in m along the shortest way between their axes, a lower bound.

    boxes (n, 8), centres (n, 3), axes (n, 9): as in `far_bodies.Clearances`, whose `xmat` the last one is. The nearest
    points of the axes: Ericson, Real-Time Collision Detection (2005), section 5.1.9.
    """
    dot, first, second, reach = 0.0, 0.0, 0.0, half_length(boxes, other)
    for k in range(3):
        away = centres[one, k] - centres[other, k]
        dot += axes[one, 3 * k + 2] * axes[other, 3 * k + 2]
        first += axes[one, 3 * k + 2] * away
        second += axes[other, 3 * k + 2] * away
    slant = 1.0 - dot * dot
    s = within((dot * second - first) / slant, half_length(boxes, one)) if slant > 1e-9 else 0.0
    t = dot * s + second
    if abs(t) > reach:
        t = within(t, reach)
        s = within(dot * t - first, half_length(boxes, one))
    square, along, at_one, at_other = 0.0, 0.0, 0.0, 0.0
    for k in range(3):
        apart = centres[other, k] - centres[one, k]
        way = apart + t * axes[other, 3 * k + 2] - s * axes[one, 3 * k + 2]
        square += way * way
        along += way * apart
        at_one += way * axes[one, 3 * k + 2]
        at_other += way * axes[other, 3 * k + 2]
    length = sqrt(square)
    if length < 1e-9:
        return -1.0
    reaches = reach_along(boxes, one, at_one / length) + reach_along(boxes, other, at_other / length)
    return float(along / length - reaches)
