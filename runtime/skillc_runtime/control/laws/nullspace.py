"""Keeps the posture of a redundant arm without moving its tool.

tau_0 = k (q_n - q) - d dq;  (J J^T + lam^2 I) y = J tau_0;  tau_null = tau_0 - J^T y
A share lam^2 / (s_i^2 + lam^2) of tau_0 reaches the tool along singular direction i, so lam stays tiny until the arm
comes near a singularity, where s_i falls and the solution would grow.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, product, times, transposed_times

REGULARISATION = 1e-6
"""lam^2 away from singularities."""

SINGULAR_BELOW, SINGULAR_REGULARISATION = 5e-3, 1e-2
"""Manipulability sqrt(det J J^T) below which lam^2 rises, and what it rises to."""


@inlined
def regularisation(manipulability: float) -> float:
    """Return lam^2 for the manipulability of the period before; both have no unit."""
    near = max(0.0, 1 - manipulability / SINGULAR_BELOW)
    return REGULARISATION + SINGULAR_REGULARISATION * near * near


@compiled
def posture_torque(
    tau: OutVector, q: Vector, dq: Vector, J: Matrix, rest: Vector, stiffness: float, manipulability: float
) -> float:
    """Compute tau_null, damped as for unit inertia. Return the manipulability now.

    It is the product of the Cholesky factor's diagonal.
    tau: (nv,) in N m; tau_null is written there.
    q: (nv,) in rad.
    dq: (nv,) in rad/s.
    J: (6, nv), m and rad per rad, base axes.
    rest: (nv,) in rad.
    stiffness: N m/rad.
    manipulability: no unit, that of the period before.
    """
    damping, lam_square = 2 * sqrt(stiffness), regularisation(manipulability)
    for j in range(tau.size):
        tau[j] = stiffness * (rest[j] - q[j]) - damping * dq[j]
    gram, wrench, y, part = np.empty((6, 6)), np.empty(6), np.empty(6), np.empty(tau.size)
    product(J, J.T, gram)
    for i in range(6):
        gram[i, i] += lam_square
    cholesky(gram)
    times(J, tau, wrench)
    cholesky_solve(gram, wrench, y)
    transposed_times(J, y, part)
    tau -= part
    return float(gram[0, 0] * gram[1, 1] * gram[2, 2] * gram[3, 3] * gram[4, 4] * gram[5, 5])
