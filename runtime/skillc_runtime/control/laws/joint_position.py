"""Joint control: computed torque for torque-controlled arms; positions or speeds for arms with servos."""

from __future__ import annotations

from skillc_runtime.control.limits import limit_joints, limit_torque
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import times
from skillc_runtime.motion.pose import Array

BANDWIDTH = 20.0
"""Natural frequency of the computed-torque servo in rad/s; critically damped."""


@inlined
def computed_torque(tau: Array, limits: Array, state: ArmState, reference: Array, longest: float) -> None:
    """tau = M (ddq_d + 2 w (dq_d - dq) + w^2 (q_d - q)) + bias, limited.

    tau: (nv,) in N m; it is written.
    limits: (5, nv) in N m and rad, of the joints, see `TorqueLimit`.
    reference: (3, nv), q_d, dq_d, ddq_d in rad, rad/s, rad/s^2.
    longest: N m, the greatest change of tau without bias.
    """
    wanted, free = np.empty(tau.size), np.empty(tau.size)
    for j in range(tau.size):
        error, speed_error = reference[0, j] - state.q[j], reference[1, j] - state.dq[j]
        wanted[j] = 2 * BANDWIDTH * speed_error + BANDWIDTH * BANDWIDTH * error + reference[2, j]
    times(state.mass_matrix, wanted, free)
    limit_torque(tau, limits, free, state.q, state.bias, longest)


@inlined
def move_servos(limits: Array, state: ArmState, reference: Array, period: float) -> bool:
    """Command the positions of joints of a reference as limits allow; False if blocked.

    limits: (9, nv) in rad, of the joints, see `JointLimit`.
    reference: (3, nv) in rad, rad/s, rad/s^2.
    period: s.
    """
    return bool(limit_joints(limits, reference[0], state.q, period))
