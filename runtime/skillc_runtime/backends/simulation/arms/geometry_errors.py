"""How the links of a simulated arm differ from those of its own, nominal model, and what it takes for its pose.

A link i is really at p_i + o_i in the frame of the link before, and turned by Exp(t_i). So the tool centre point x of
the true arm differs from where the arm's model has it, to first order, by

    dx = sum_i R_i o_i + (R_i t_i) x (x - p_i) + J_v e,    dr = sum_i R_i t_i + J_w e

with R_i the frame of the link before and e what the transmissions make of the joints; the arm takes x - dx and
Exp(-dr) R for its pose. B. Mooring, Z. Roth, M. Driels:
Fundamentals of Manipulator Calibration, Wiley, 1991, chapter 3.
"""

from __future__ import annotations

from math import cos, sin
from typing import Any, Final

import msgspec
import numpy as np

from skillc_runtime.devices.reality import Sizes
from skillc_runtime.motion.arrays import Integers, Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import cross, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose, exp, quaternion_from_rotation

WAVES: Final = 200.0
"""Periods of the error of a transmission in a turn of the joint: two in a turn of the motor of a strain wave gear that
reduces by about a hundred."""


class GeometryErrors(msgspec.Struct, frozen=True):
    """The errors of one arm.

    links (n, 6): m and rad, o and t above, of each link that is not where it should be, `bodies` (n, 2) being its
    number and that of the link before; wave (nv,): rad, the amplitude of the errors of transmissions. position
    (nbody, 3) m, rotation (nbody, 9): of all bodies, in the world; they change with the simulation. exist: 1 if
    there are any.
    """

    links: Matrix
    bodies: Integers
    wave: Vector
    position: Matrix
    rotation: Matrix
    exist: float


def draw_links(sizes: Sizes, joints: int) -> Array:
    """Return by how much each link (joints, 6) is off, m and rad, in the frame of the link before."""
    halves = [np.reshape(sizes.get(each, (0.0,) * 3 * joints), (joints, 3)) for each in ("linkOffset", "linkTurn")]
    return np.hstack(halves)


def move_links(model: Any, sizes: Sizes) -> None:
    """Put the links of an arm's own model, an MjSpec, where they really are."""
    links = draw_links(sizes, len(model.joints))
    for joint, error in zip(model.joints, links, strict=True):
        if error.any():
            link = joint.parent
            turned = exp(error[3:]) @ Pose.of(np.zeros(3), np.asarray(link.quat)).rotation
            link.pos, link.quat = np.asarray(link.pos) + error[:3], quaternion_from_rotation(turned)


def make_mounting_error(sizes: Sizes) -> Pose | None:
    """Return where the base really is in the frame in which the world model has it; None if it is there."""
    offset, turn = (np.asarray(sizes.get(each, np.zeros(3))) for each in ("mountingOffset", "mountingTurn"))
    return Pose(offset, exp(turn)) if offset.any() or turn.any() else None


def make_geometry_errors(sizes: Sizes, joints: list[int], model: Any, data: Any) -> GeometryErrors:
    """Return the errors of the arm with these joints of a model."""
    links = draw_links(sizes, len(joints))
    off = np.flatnonzero(np.abs(links).sum(axis=1))
    bodies = [int(model.jnt_bodyid[joints[each]]) for each in off]
    pairs = np.array([(each, model.body_parentid[each]) for each in bodies], dtype=np.int64).reshape(-1, 2)
    wave = np.array(np.broadcast_to(sizes.get("transmissionError", 0.0), len(joints)), dtype=np.float64)
    return GeometryErrors(links[off], pairs, wave, data.xpos, data.xmat, float(off.size > 0 or wave.any()))


@inlined
def measure_joint(errors: GeometryErrors, joint: int, q: float, dq: float) -> tuple[float, float]:
    """Return what the encoder of a joint makes of its angle in rad and its speed in rad/s."""
    wave = errors.wave[joint]
    if wave == 0.0:
        return q, dq
    return q + wave * sin(WAVES * q), dq * (1.0 + wave * WAVES * cos(WAVES * q))


@inlined
def misjudge_tool(
    errors: GeometryErrors, base: Pose, waves: Vector, J: Matrix, position: OutVector, rotation: OutMatrix
) -> None:
    """Let the true pose of the tool centre point, in base, become the one that the arm's model has; both are changed.

    base: of the arm, in the world. waves (nv,): rad, what encoders measure more than is so. J (6, nv): of the tool.
    """
    if errors.exist == 0.0:
        return
    away, turn, here, axis, lever, moved = np.zeros(3), np.zeros(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    times(base.rotation, position, here)
    for row in range(errors.links.shape[0]):
        link, before = errors.bodies[row, 0], errors.bodies[row, 1]
        frame = errors.rotation[before]
        for i in range(3):
            axis[i] = 0.0
            for k in range(3):
                away[i] += frame[3 * i + k] * errors.links[row, k]
                axis[i] += frame[3 * i + k] * errors.links[row, 3 + k]
            turn[i] += axis[i]
            lever[i] = here[i] + base.position[i] - errors.position[link, i]
        cross(axis, lever, moved)
        for i in range(3):
            away[i] += moved[i]
    transposed_times(base.rotation, away, lever)
    transposed_times(base.rotation, turn, axis)
    for i in range(3):
        position[i] -= lever[i]
        axis[i] = -axis[i]
        for j in range(waves.size):
            position[i] += J[i, j] * waves[j]
            axis[i] += J[3 + i, j] * waves[j]
    _turn(rotation, axis)


@inlined
def _turn(rotation: OutMatrix, axis: Vector) -> None:
    """Turn a rotation (3, 3) by a small rotation vector (3,) in rad, to second order."""
    before, square = np.empty((3, 3)), axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]
    for i in range(3):
        for j in range(3):
            before[i, j] = rotation[i, j]
    for j in range(3):
        along = axis[0] * before[0, j] + axis[1] * before[1, j] + axis[2] * before[2, j]
        for i in range(3):
            k, m = (i + 1) % 3, (i + 2) % 3
            turned = axis[k] * before[m, j] - axis[m] * before[k, j]
            rotation[i, j] = before[i, j] * (1.0 - 0.5 * square) + turned + 0.5 * axis[i] * along
