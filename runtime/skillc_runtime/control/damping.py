"""Dampers for an arm that takes torques, designed from the inertia that its tool has where it is."""

from __future__ import annotations

from math import sqrt

import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.numerics.compiled import Matrix, OutMatrix, OutVector, Vector, compiled, part
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, product, times
from skillc_runtime.motion.pose import Array

BRAKE_RATE = 250.0
"""1/s, how fast a tool comes down to the greatest speed with which it may yield; stable down to 250 Hz."""

LEAST_MOBILITY = 1e-3
"""Added to the tool's inverse inertia, 1/kg and 1/(kg m^2): at a singularity the tool seems heavy, not immovable."""


@part
def tool_inertia(inertia: Array, mobility: Array, J: Array, mass_matrix: Array, rotation: Array, frame: Array) -> None:
    """mobility (6, 6) = J_C M^-1 J_C^T, inertia its inverse but for the least mobility; C: rotation @ frame."""
    joints = J.shape[1]
    axes, J_C, factor, column = np.empty((3, 3)), np.empty((6, joints)), mass_matrix.copy(), np.empty(joints)
    whole, unit = np.empty((6, 6)), np.zeros(6)
    product(rotation, frame, axes)
    product(axes.T, J[:3], J_C[:3])
    product(axes.T, J[3:], J_C[3:])
    cholesky(factor)
    for i in range(6):
        cholesky_solve(factor, J_C[i], column)
        times(J_C, column, mobility[i])
        mobility[i, i] += LEAST_MOBILITY
        for j in range(6):
            whole[i, j] = mobility[i, j]
    cholesky(whole)
    for i in range(6):
        unit[i] = 1.0
        cholesky_solve(whole, unit, inertia[i])
        unit[i] = 0.0


@compiled
def design_damping(
    damping: OutVector,
    braking: OutVector,
    inertia: OutMatrix,
    J: Matrix,
    mass_matrix: Matrix,
    rotation: Matrix,
    frame: Matrix,
    stiffness: Vector,
    floor: Vector,
    damping_ratio: float,
    fastest: float,
) -> None:
    """Lam_C = (J_C M^-1 J_C^T)^-1; D_i = 2 zeta sqrt(K_i Lam_C,ii), at least the floor; B_i = rate / (Lam_C^-1)_ii.

    Where Lam_C^-1 D would decay faster than `fastest` in 1/s, by its greatest possible eigenvalue, D is less.
    """
    mobility, added, square = np.empty((6, 6)), np.empty(6), 0.0
    tool_inertia(inertia, mobility, J, mass_matrix, rotation, frame)
    for i in range(6):
        added[i] = max(2 * damping_ratio * sqrt(stiffness[i] * inertia[i, i]) - floor[i], 0.0)
    for i in range(6):
        decay = 0.0
        for j in range(6):
            decay += mobility[i, j] * mobility[i, j] * (floor[j] + added[j])
        square += (floor[i] + added[i]) * decay
    share = min(1.0, fastest / sqrt(square))
    for i in range(6):
        damping[i] = floor[i] + share * added[i]
        braking[i] = BRAKE_RATE / mobility[i, i]


def damping_rate(state: ArmState, damping: float, rotational_damping: float) -> float:
    """Return the fastest decay in 1/s that dampers on all axes cause; above 2 / h explicit damping explodes."""
    D = np.repeat([damping, rotational_damping], 3)
    rates = np.linalg.eigvals(np.linalg.solve(state.mass_matrix, state.jacobian.T @ (D[:, None] * state.jacobian)))
    return float(np.abs(rates).max())
