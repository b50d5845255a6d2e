"""The error of the tool in the compliance frame, for all control laws."""

from __future__ import annotations

from math import sqrt

import msgspec
import numpy as np

from skillc_runtime.motion.arrays import OutMatrix
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import product, rotation_between
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import AppliedCompliance, SampledReference

CLAMP_M, CLAMP_RAD = 0.05, 0.3
"""Greatest error that acts on a spring, so that a wrong goal cannot produce an unbounded force."""

ERROR, TWIST, ACCELERATION, MEASURED, HELD, SOFTNESS, EXERTED, DAMPING, BRAKING = range(9)
"""Rows of `TaskError.rows`."""


class TaskError(msgspec.Struct, frozen=True):
    """Errors, velocities and forces along the axes of the compliance frame C.

    axes (3, 3): C in base. rows (9, 6), each [linear; angular]: ERROR, tool minus reference, m and rad, clamped in
    length; TWIST, m/s and rad/s, and ACCELERATION, per s, of the reference; MEASURED: the velocity of the tool, m/s and
    rad/s, or the wrench on it, N and N m, as the law passes it; HELD: 1 for a stiff axis, 0 for a released one,
    between them below a tenth of the full stiffness; SOFTNESS: ten times the inverse of the full stiffness, m/N and
    rad/(N m). For the impedance law: EXERTED, N and N m; DAMPING and BRAKING, N s/m and N m s/rad.

    All rows are one array, since each argument of a compiled call costs time.
    """

    axes: OutMatrix
    rows: OutMatrix


def make_task_error(stiffness: Array) -> TaskError:
    """Return the arrays for an arm with `stiffness` (6,) along the axes of C, N/m and N m/rad, without releases."""
    task = TaskError(np.eye(3), np.zeros((9, 6)))
    task.rows[SOFTNESS] = 10 / stiffness
    return task


@inlined
def compute_task_error(
    task: TaskError, tool: Pose, reference: SampledReference, compliance: AppliedCompliance, measured: Array
) -> None:
    """Compute axes and the first five rows of `task`; measured (6,), m/s and rad/s or N and N m, and tool in base.

    HELD scales the first three rows, since a released axis does not follow the reference.
    """
    rows, axes, rotation, in_base = task.rows, task.axes, reference.rows[1:4], np.empty((8, 3))
    product(rotation, compliance.frame, axes)
    rotation_between(rotation, tool.rotation, in_base[1])
    for i in range(3):
        in_base[0, i] = tool.position[i] - reference.rows[0, i]
        for row in range(4):
            in_base[2 + row, i] = reference.rows[4 + row, i]
        in_base[6, i], in_base[7, i] = measured[i], measured[3 + i]
    product(in_base, axes, rows[:4].reshape(8, 3))
    for i in range(6):
        rows[HELD, i] = min(compliance.stiffness[i] * rows[SOFTNESS, i], 1.0)
        for row in range(3):
            rows[row, i] *= rows[HELD, i]
    clamp_length(rows[ERROR, :3], CLAMP_M)
    clamp_length(rows[ERROR, 3:], CLAMP_RAD)


@inlined
def clamp_length(vector: Array, longest: float) -> None:
    """Scale a vector (3,), in any frame and any unit, down in place to a length of at most `longest`."""
    square = vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]
    if square > longest * longest:
        vector *= longest / sqrt(square)


@inlined
def speed_excess(velocity: float, fastest: float) -> float:
    """Return by how much a velocity in m/s exceeds `fastest` m/s in the direction of the sign of `fastest`; else 0."""
    excess = velocity - fastest
    return excess if excess * fastest > 0 else 0.0
