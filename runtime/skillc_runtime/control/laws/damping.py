"""Damping of a torque-controlled arm, from the inertia of its tool in the present posture."""

from __future__ import annotations

import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, product, times
from skillc_runtime.motion.pose import Array

BRAKE_RATE = 250.0
"""1/s, rate with which excess speed of a tool decays; stable down to a control rate of 250 Hz."""

LEAST_MOBILITY = 1e-3
"""Added to the inverse inertia of the tool, 1/kg and 1/(kg m^2), which keeps it regular at a singularity."""


@inlined
def tool_inertia(inertia: Array, mobility: Array, J: Array, mass_matrix: Array, rotation: Array, frame: Array) -> None:
    """mobility = J_C M^-1 J_C^T + least mobility; inertia is its inverse. The axes of C are rotation @ frame, in base.

    inertia: (6, 6) in kg and kg m^2, along the axes of C; it is written.
    mobility: (6, 6) in 1/kg and 1/(kg m^2), along the axes of C; it is written.
    J: (6, nv), m and rad per rad, base axes.
    mass_matrix: M (nv, nv) in kg m^2.
    rotation: (3, 3), rotation (3, 3) from tool to base.
    frame: (3, 3), axes (3, 3) of C in the tool.
    """
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


def damping_rate(state: ArmState, damping: float, rotational_damping: float) -> float:
    """Return the fastest decay rate in 1/s of damping along all axes; above 2 / h explicit damping is unstable.

    damping: N s/m; rotational_damping: N m s/rad.
    """
    D = np.repeat([damping, rotational_damping], 3)
    rates = np.linalg.eigvals(np.linalg.solve(state.mass_matrix, state.jacobian.T @ (D[:, None] * state.jacobian)))
    return float(np.abs(rates).max())
