"""Estimates the external wrench on a torque-controlled arm without wrist sensor, from its momentum.

r = (M (dq_1 - dq_0) - int (tau - bias) dt) / T over short windows, low-passed; W = (J J^T + lam^2 I)^-1 J r.
De Luca et al. 2006, with the mass matrix taken as constant within a window.
"""

from __future__ import annotations

from math import exp

import msgspec
import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.arrays import Matrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, product, times, transposed_times
from skillc_runtime.motion.pose import Array

WINDOW_S = 0.01
"""Time over which momentum is integrated before it is compared."""

LAG_S = 0.01
"""Time constant of the low-pass on the comparison."""

DAMPING = 1e-3
"""lam^2: near a singularity it reduces the estimate along the lost direction instead of amplifying noise."""

MEASURING = 1e-5
"""lam^2 for forces that are averaged: what noise does to them matters less than what damping takes away."""


class ObserverMemory(msgspec.Struct, frozen=True):
    """What the observer keeps between control periods, for an arm.

    dq, impulse, torque (nv,): rad/s at the start of the window, N m s in it, N m as estimated; elapsed (1,): s of it.
    total (1 + nv,): s of all windows, and the external impulse in them, N m s: noise of speeds is in its ends only.
    """

    dq: OutVector
    impulse: OutVector
    torque: OutVector
    elapsed: OutVector
    total: OutVector


class MomentumObserver:
    """Estimates the wrench of the environment on the tool of one arm from its commands and its motion."""

    def __init__(self, state: ArmState) -> None:
        joints = state.q.size
        impulse, torque, total = np.zeros(joints), np.zeros(joints), np.zeros(1 + joints)
        self.memory = ObserverMemory(state.dq.copy(), impulse, torque, np.zeros(1), total)
        self._wrench = np.zeros(6)

    def add_command(self, tau: Array, bias: Array, period: float) -> None:
        """Add the joint torques of the next period.

        tau: (nv,) in N m, bias included.
        bias: (nv,) in N m.
        period: s.
        """
        add_impulse(self.memory.impulse, tau, bias, period)

    def step(self, state: ArmState, period: float) -> None:
        """Update the estimate with the state measured at the end of a period of `period` s."""
        observe(self.memory, state, period)

    def wrench(self, state: ArmState, damping: float = DAMPING) -> Array:
        """Return the wrench (6,) in N and N m, base axes, at the tool; the array is reused. `damping` is lam^2."""
        estimate_wrench(self._wrench, self.memory.torque, state.jacobian, damping)
        return self._wrench

    def unexplained(self, state: ArmState) -> tuple[int, float]:
        """Return the joint with the greatest torque that no force on the tool explains, and that torque in N m."""
        joint, torque = find_unexplained_torque(self.memory.torque, state.jacobian)
        return int(joint), float(torque)


@compiled
def add_impulse(impulse: OutVector, tau: Vector, bias: Vector, period: float) -> None:
    """Add (tau - bias) period to the impulse.

    impulse: (nv,) in N m s.
    tau: (nv,) in N m.
    bias: (nv,) in N m.
    period: s.
    """
    for j in range(impulse.size):
        impulse[j] += (tau[j] - bias[j]) * period


@inlined
def observe_momentum(memory: ObserverMemory, state: ArmState, period: float) -> None:
    """At the end of a window, let the external torque (nv,) in N m follow (M (dq_now - dq) - impulse) / elapsed.

    period: s.
    """
    torque, impulse, dq, elapsed = memory.torque, memory.impulse, memory.dq, memory.elapsed
    elapsed[0] += period
    if elapsed[0] <= WINDOW_S - period / 2:
        return
    share = 1 - exp(-elapsed[0] / LAG_S)
    faster, gained = np.empty(torque.size), np.empty(torque.size)
    for j in range(torque.size):
        faster[j] = state.dq[j] - dq[j]
    times(state.mass_matrix, faster, gained)
    for j in range(torque.size):
        memory.total[1 + j] += gained[j] - impulse[j]
        torque[j] += share * ((gained[j] - impulse[j]) / elapsed[0] - torque[j])
        dq[j], impulse[j] = state.dq[j], 0.0
    memory.total[0] += elapsed[0]
    elapsed[0] = 0.0


@compiled
def estimate_wrench(wrench: OutVector, torque: Vector, J: Matrix, damping: float) -> None:
    """wrench = (J J^T + lam^2 I)^-1 J torque.

    wrench: (6,) in N and N m, base axes; it is written.
    torque: (nv,) in N m.
    J: (6, nv), [linear m; angular rad] per rad, base axes.
    damping: lam^2, in the units of J J^T, m^2 and rad^2.
    """
    gram, force = np.empty((6, 6)), np.empty(6)
    product(J, J.T, gram)
    for i in range(6):
        gram[i, i] += damping
    cholesky(gram)
    times(J, torque, force)
    cholesky_solve(gram, force, wrench)


@compiled
def find_unexplained_torque(torque: Vector, J: Matrix) -> tuple[int, float]:
    """Return the joint with the greatest |torque - J_v^T f| and that, N m, for the force f that explains most of it.

    f = (J_v J_v^T + lam^2 I)^-1 J_v torque. torque (nv,): N m; J (6, nv): [linear m; angular rad] per rad.
    """
    gram, pulled, force, explained = np.empty((3, 3)), np.empty(3), np.empty(3), np.empty(torque.size)
    product(J[:3], J[:3].T, gram)
    for i in range(3):
        gram[i, i] += DAMPING
    cholesky(gram)
    times(J[:3], torque, pulled)
    cholesky_solve(gram, pulled, force)
    transposed_times(J[:3], force, explained)
    joint, greatest = 0, 0.0
    for j in range(torque.size):
        left = abs(torque[j] - explained[j])
        if left > greatest:
            joint, greatest = j, left
    return joint, greatest


@compiled
def observe(memory: ObserverMemory, state: ArmState, period: float) -> None:
    """At the end of a window, let the external torque (nv,) in N m follow (M (dq_now - dq) - impulse) / elapsed.

    The state is that at the end of a period in s.
    """
    observe_momentum(memory, state, period)
