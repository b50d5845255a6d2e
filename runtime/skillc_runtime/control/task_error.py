"""The error of the tool in the compliance frame, as all laws need it."""

from __future__ import annotations

from math import sqrt

import numpy as np

from skillc_runtime.motion.numerics.compiled import part
from skillc_runtime.motion.numerics.linear import product, rotation_between
from skillc_runtime.motion.pose import Array

CLAMP_M, CLAMP_RAD = 0.05, 0.3
"""Greatest error that a spring sees, so that a wrong goal cannot produce an unbounded force."""

ERROR, TWIST, ACCELERATION, MEASURED, HELD, SOFTNESS, EXERTED, DAMPING, BRAKING = range(9)
"""Rows of `TaskError.rows`; the last three are for laws to use."""


class TaskError:
    """What `task_error` computes for an arm whose axes have `stiffness` (6,) when nobody has released them.

    One block of rows is one argument: what a compiled call costs beside its work grows with their number.
    """

    def __init__(self, stiffness: Array) -> None:
        self.axes, self.rows = np.eye(3), np.zeros((9, 6))
        self.rows[SOFTNESS] = 10 / stiffness


@part
def task_error(
    rows: Array,
    axes: Array,
    tool_position: Array,
    tool_rotation: Array,
    reference: Array,
    stiffness: Array,
    frame: Array,
    measured: Array,
) -> None:
    """Compute error and feed-forward in the compliance frame C from tool pose, reference (8, 3) and compliance.

    axes (3, 3): C in base. rows: error, tool minus reference, m and rad, clamped in length; twist and acceleration of
    the reference; `measured`, given in base; what is held: 1 for a stiff axis, 0 for a released one, between below a
    tenth of the full stiffness. That scales the first three rows, since a released axis follows no reference.
    """
    rotation, in_base = reference[1:4], np.empty((8, 3))
    product(rotation, frame, axes)
    rotation_between(rotation, tool_rotation, in_base[1])
    for i in range(3):
        in_base[0, i] = tool_position[i] - reference[0, i]
        for row in range(4):
            in_base[2 + row, i] = reference[4 + row, i]
        in_base[6, i], in_base[7, i] = measured[i], measured[3 + i]
    product(in_base, axes, rows[:4].reshape(8, 3))
    for i in range(6):
        rows[HELD, i] = min(stiffness[i] * rows[SOFTNESS, i], 1.0)
        for row in range(3):
            rows[row, i] *= rows[HELD, i]
    shorten(rows[ERROR, :3], CLAMP_M)
    shorten(rows[ERROR, 3:], CLAMP_RAD)


@part
def shorten(vector: Array, longest: float) -> None:
    """Shorten a vector (3,) in place to a length."""
    square = vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]
    if square > longest * longest:
        vector *= longest / sqrt(square)


@part
def over(velocity: float, fastest: float) -> float:
    """Return by how much a velocity is over the greatest one, whose sign says which way that holds."""
    excess = velocity - fastest
    return excess if excess * fastest > 0 else 0.0
