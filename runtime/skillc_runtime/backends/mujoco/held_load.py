"""What things in hands add to the bias of arms, by recursive Newton-Euler for the bodies of the things only."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.backends.mujoco.model_map import ModelMap
from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import inlined


class Held(msgspec.Struct, frozen=True):
    """All bodies that are held, in the tight model, and the degrees of freedom that move them.

    chains (n, 3): the place of a body in `bodies`, in this order, a degree of freedom that moves it, and its number in
    the free model, whose `bias` must not have the part of the body; -1 if it is of the thing itself, as a pad has it.
    scratch (3, 6): memory for the computation.
    """

    bodies: Vector
    chains: Matrix
    gravity: Vector
    inertias: Matrix
    velocities: Matrix
    turning: Matrix
    axes: Matrix
    qvel: Vector
    bias: OutVector
    scratch: OutMatrix


@inlined
def times_inertia(inertia: Vector, v: Vector, out: OutVector) -> None:
    """out = I v for a spatial inertia [Ixx Iyy Izz Ixy Ixz Iyz mx my mz m] and [angular; linear] v."""
    xx, yy, zz, xy, xz, yz = inertia[0], inertia[1], inertia[2], inertia[3], inertia[4], inertia[5]
    x, y, z, mass = inertia[6], inertia[7], inertia[8], inertia[9]
    out[0] = xx * v[0] + xy * v[1] + xz * v[2] - z * v[4] + y * v[5]
    out[1] = xy * v[0] + yy * v[1] + yz * v[2] + z * v[3] - x * v[5]
    out[2] = xz * v[0] + yz * v[1] + zz * v[2] - y * v[3] + x * v[4]
    out[3] = z * v[1] - y * v[2] + mass * v[3]
    out[4] = x * v[2] - z * v[0] + mass * v[4]
    out[5] = y * v[0] - x * v[1] + mass * v[5]


@inlined
def add_cross_force(v: Vector, f: Vector, out: OutVector) -> None:
    """out += v x* f: what a momentum f needs to turn with the velocity v, both [angular; linear]."""
    out[0] += v[1] * f[2] - v[2] * f[1] + v[4] * f[5] - v[5] * f[4]
    out[1] += v[2] * f[0] - v[0] * f[2] + v[5] * f[3] - v[3] * f[5]
    out[2] += v[0] * f[1] - v[1] * f[0] + v[3] * f[4] - v[4] * f[3]
    out[3] += v[1] * f[5] - v[2] * f[4]
    out[4] += v[2] * f[3] - v[0] * f[5]
    out[5] += v[0] * f[4] - v[1] * f[3]


@inlined
def take_off_load(held: Held) -> None:
    """Take off the bias of arms what the bodies that they hold add to it: their weight and their Coriolis forces.

    An arm knows what it was told to carry, not what it does carry. For each body a = -g + sum S' dq,
    f = I a + v x* I v, and S^T f is its part of the bias.
    """
    acceleration, momentum, force = held.scratch[0], held.scratch[1], held.scratch[2]
    end = 0
    for place in range(held.bodies.size):
        body, first = int(held.bodies[place]), end
        for k in range(3):
            acceleration[k], acceleration[3 + k] = 0.0, -held.gravity[k]
        while end < held.chains.shape[0] and int(held.chains[end, 0]) == place:
            dof = int(held.chains[end, 1])
            for k in range(6):
                acceleration[k] += held.turning[dof, k] * held.qvel[dof]
            end += 1
        times_inertia(held.inertias[body], acceleration, force)
        times_inertia(held.inertias[body], held.velocities[body], momentum)
        add_cross_force(held.velocities[body], momentum, force)
        for row in range(first, end):
            dof, shown, part = int(held.chains[row, 1]), int(held.chains[row, 2]), 0.0
            if shown >= 0:
                for k in range(6):
                    part += held.axes[dof, k] * force[k]
                held.bias[shown] -= part


def make_held(rows: ModelMap, blocks: Sequence[int], free: Any, tight_model: Any, tight: Any) -> Held:
    """Return what is held, by the outermost bodies in the free model."""
    chains, bodies = list[tuple[int, int, int]](), list[int]()
    for block in blocks:
        root = int(rows.bodies[block])
        of_hand = find_chain(tight_model, root)
        for body in find_bodies(tight_model, root):
            for dof in find_chain(tight_model, body):
                chains.append((len(bodies), dof, int(rows.dofs[dof]) if dof in of_hand else -1))
            bodies.append(body)
    return Held(
        np.array(bodies, dtype=np.float64), np.array(chains, dtype=np.float64).reshape(-1, 3), tight_model.opt.gravity,
        tight.cinert, tight.cvel, tight.cdof_dot, tight.cdof, tight.qvel, free.qfrc_bias, np.zeros((3, 6)),
    )  # fmt: skip


def find_bodies(model: Any, root: int) -> Iterator[int]:
    """Yield a body and all that hang on it."""
    found = {root}
    for body in range(root, model.nbody):  # children come after their parents
        if body == root or int(model.body_parentid[body]) in found:
            found.add(body)
            yield body


def find_chain(model: Any, body: int) -> list[int]:
    """Return the degrees of freedom that move a body, the outermost last."""
    chain: list[int] = []
    while body:
        first = int(model.body_dofadr[body])
        chain = [*range(first, first + int(model.body_dofnum[body])), *chain]
        body = int(model.body_parentid[body])
    return chain
