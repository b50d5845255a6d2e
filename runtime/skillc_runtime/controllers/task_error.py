"""The error of the tool in the compliance frame, as all laws need it."""

from __future__ import annotations

from math import sqrt

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.numerics.compiled import part
from skillc_runtime.numerics.linear import product, rotation_between

CLAMP_M, CLAMP_RAD = 0.05, 0.3
"""Greatest error that a spring sees, so that a wrong goal cannot produce an unbounded force."""

ERROR, TWIST, ACCELERATION, MEASURED = 0, 1, 2, 3
"""Rows of `TaskError.rows`."""


class TaskError:
    """What `task_error` computes for an arm whose axes have `stiffness` (6,) when nobody has released them."""

    def __init__(self, stiffness: Array) -> None:
        self.softness = 10 / stiffness
        self.axes, self.held, self.rows = np.eye(3), np.zeros(6), np.zeros((4, 6))


@part
def task_error(
    rows: Array,
    axes: Array,
    held: Array,
    tool_position: Array,
    tool_rotation: Array,
    position: Array,
    rotation: Array,
    twist: Array,
    acceleration: Array,
    stiffness: Array,
    frame: Array,
    softness: Array,
    measured: Array,
) -> None:
    """Compute error and feed-forward in the compliance frame C from tool pose, reference, compliance and softness.

    axes (3, 3): C in base. rows (4, 6): error, tool minus reference, m and rad, clamped in length; twist and
    acceleration of the reference; `measured`, given in base. held (6,): 1 for a stiff axis, 0 for a released one,
    between below a tenth of the full stiffness; it scales the first three rows, since a released axis follows no
    reference.
    """
    held[:] = np.minimum(stiffness * softness, 1.0)
    product(rotation, frame, axes)
    in_base = np.empty((4, 6))
    in_base[ERROR, :3] = tool_position - position
    rotation_between(rotation, tool_rotation, in_base[ERROR, 3:])
    in_base[TWIST] = twist
    in_base[ACCELERATION] = acceleration
    in_base[MEASURED] = measured
    product(in_base.reshape(8, 3), axes, rows.reshape(8, 3))
    rows[:3] *= held
    shorten(rows[ERROR, :3], CLAMP_M)
    shorten(rows[ERROR, 3:], CLAMP_RAD)


@part
def shorten(vector: Array, longest: float) -> None:
    """Shorten a vector (3,) in place to a length."""
    square = vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]
    if square > longest * longest:
        vector *= longest / sqrt(square)
