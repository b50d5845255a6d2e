"""Keeps the posture of a redundant arm without moving its tool.

tau_0 = k (q_n - q) - d dq;  (J J^T + lam^2 I) y = J tau_0;  tau_null = tau_0 - J^T y
A share lam^2 / (s_i^2 + lam^2) of tau_0 reaches the tool along singular direction i, so lam stays tiny until the arm
comes near a singularity, where s_i falls and the solution would grow.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import (
    cholesky,
    cholesky_solve,
    copy_matrix,
    product,
    times,
    transposed_times,
)

REGULARISATION = 1e-6
"""lam^2 away from singularities."""

SINGULAR_BELOW, SINGULAR_REGULARISATION = 5e-3, 1e-2
"""Manipulability sqrt(det(J J^T + REGULARISATION I)) below which lam^2 rises, and what it rises to."""


@inlined
def regularisation(manipulability: float) -> float:
    """Return lam^2 for a manipulability; both have no unit."""
    near = max(0.0, 1 - manipulability / SINGULAR_BELOW)
    return REGULARISATION + SINGULAR_REGULARISATION * near * near


@compiled
def posture_torque(tau: OutVector, q: Vector, dq: Vector, J: Matrix, rest: Vector, stiffness: float) -> float:
    """Compute tau_null, damped as for unit inertia. Return lam^2, which has no unit.

    The manipulability is the product of the diagonal of the Cholesky factor.
    tau: (nv,) in N m; tau_null is written there.
    q: (nv,) in rad.
    dq: (nv,) in rad/s.
    J: (6, nv), m and rad per rad, base axes.
    rest: (nv,) in rad.
    stiffness: N m/rad.
    """
    damping = 2 * sqrt(stiffness)
    for j in range(tau.size):
        tau[j] = stiffness * (rest[j] - q[j]) - damping * dq[j]
    gram, factor = np.empty((6, 6)), np.empty((6, 6))
    product(J, J.T, gram)
    factorise(gram, REGULARISATION, factor)
    lam_square = regularisation(factor[0, 0] * factor[1, 1] * factor[2, 2] * factor[3, 3] * factor[4, 4] * factor[5, 5])
    if lam_square > REGULARISATION:
        factorise(gram, lam_square, factor)
    wrench, y, part = np.empty(6), np.empty(6), np.empty(tau.size)
    times(J, tau, wrench)
    cholesky_solve(factor, wrench, y)
    transposed_times(J, y, part)
    tau -= part
    return lam_square


@inlined
def factorise(gram: Matrix, lam_square: float, factor: OutMatrix) -> None:
    """Fill in the Cholesky factor of gram + lam_square I.

    gram: (6, 6), no unit, in the axes of the Jacobian.
    lam_square: no unit.
    factor: (6, 6), no unit, as gram; it is written.
    """
    copy_matrix(gram, factor)
    for i in range(6):
        factor[i, i] += lam_square
    cholesky(factor)
