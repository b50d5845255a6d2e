"""How the links of a simulated arm differ from those of its own, nominal model, and what it takes for its pose.

A link i is really at p_i + o_i in the frame of the link before, and turned by Exp(t_i). So the tool centre point x of
the true arm differs from where the arm's model has it, to first order, by

    dx = sum_i R_i o_i + (R_i t_i) x (x - p_i) + J_v e,    dr = sum_i R_i t_i + J_w e

with R_i the frame of the link before and e what the transmissions make of the joints; the arm takes x - dx and
Exp(-dr) R for its pose. B. Mooring, Z. Roth, M. Driels:
Fundamentals of Manipulator Calibration, Wiley, 1991, chapter 3.
"""

from __future__ import annotations

from math import floor, pi
from typing import Any, Final

import msgspec
import numpy as np

from skillc_runtime.devices.reality import Sizes
from skillc_runtime.motion.arrays import Integers, Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import times, transposed_times
from skillc_runtime.motion.pose import Array, Pose, exp, quaternion_from_rotation

WAVES: Final = 200.0
"""Periods of the error of a transmission in a turn of the joint: two in a turn of the motor of a strain wave gear that
reduces by about a hundred."""


class GeometryErrors(msgspec.Struct, frozen=True):
    """The errors of one arm.

    links (n, 6): m and rad, o and t above, of each link that is not where it should be, `bodies` (n, 2) being its
    number and that of the link before; wave (nv,): rad, the amplitude of the errors of transmissions. position
    (nbody, 3) m, rotation (nbody, 9): of all bodies, in the world; they change with the simulation. exist: 1 if
    there are any. scratch (5, 3): for what is computed on the way.
    """

    links: Matrix
    bodies: Integers
    wave: Vector
    position: Matrix
    rotation: Matrix
    exist: float
    scratch: OutMatrix


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
    return GeometryErrors(
        links[off], pairs, wave, data.xpos, data.xmat, float(off.size > 0 or wave.any()), np.zeros((5, 3))
    )


@inlined
def find_wave(q: float) -> tuple[float, float]:
    """Return sin(w q), up to 0.06, and the slope of that, in 1/rad, of a joint at q rad: two parabolas a period."""
    turns = q * WAVES / (2.0 * pi)
    share = 2.0 * (turns - floor(turns)) - 1.0
    away = 1.0 - abs(share)
    slope = 4.0 * (1.0 - 2.0 * abs(share)) * (-WAVES / pi)
    return -4.0 * share * away, slope


@inlined
def measure_joint(errors: GeometryErrors, joint: int, q: float, dq: float) -> tuple[float, float]:
    """Return what the encoder of a joint makes of its angle in rad and its speed in rad/s."""
    wave = errors.wave[joint]
    if wave == 0.0:
        return q, dq
    value, slope = find_wave(q)
    return q + wave * value, dq * (1.0 + wave * slope)


@inlined
def misjudge_tool(
    errors: GeometryErrors, base: Pose, waves: Vector, J: Matrix, position: OutVector, rotation: OutMatrix
) -> None:
    """Let the true pose of the tool centre point, in base, become the one that the arm's model has; both are changed.

    base: of the arm, in the world. waves (nv,): rad, what encoders measure more than is so. J (6, nv): of the tool.
    """
    if errors.exist == 0.0:
        return
    scratch = errors.scratch
    here, away, turn, moved, turned = scratch[0], scratch[1], scratch[2], scratch[3], scratch[4]
    times(base.rotation, position, here)
    for i in range(3):
        here[i] += base.position[i]
        away[i] = turn[i] = 0.0
    for row in range(errors.links.shape[0]):
        _add_link(errors, row, here, away, turn)
    transposed_times(base.rotation, away, moved)
    transposed_times(base.rotation, turn, turned)
    for i in range(3):
        further, more = -moved[i], -turned[i]
        for j in range(waves.size):
            further += J[i, j] * waves[j]
            more += J[3 + i, j] * waves[j]
        position[i] += further
        turned[i] = more
    _turn(rotation, turned)


@inlined
def _add_link(errors: GeometryErrors, row: int, here: Vector, away: OutVector, turn: OutVector) -> None:
    """Add by how far the tool, at `here` (3,) m, is away (3,) m and turned (3,) rad by the error of one link."""
    links, link, before = errors.links, errors.bodies[row, 0], errors.bodies[row, 1]
    frame, at = errors.rotation[before], errors.position[link]
    a, b, c = links[row, 3], links[row, 4], links[row, 5]
    x, y, z = here[0] - at[0], here[1] - at[1], here[2] - at[2]
    u = frame[0] * a + frame[1] * b + frame[2] * c
    v = frame[3] * a + frame[4] * b + frame[5] * c
    w = frame[6] * a + frame[7] * b + frame[8] * c
    a, b, c = links[row, 0], links[row, 1], links[row, 2]
    away[0] += frame[0] * a + frame[1] * b + frame[2] * c + v * z - w * y
    away[1] += frame[3] * a + frame[4] * b + frame[5] * c + w * x - u * z
    away[2] += frame[6] * a + frame[7] * b + frame[8] * c + u * y - v * x
    turn[0] += u
    turn[1] += v
    turn[2] += w


@inlined
def _turn(rotation: OutMatrix, axis: Vector) -> None:
    """Turn a rotation (3, 3) by a small rotation vector (3,) in rad, to second order."""
    a, b, c = axis[0], axis[1], axis[2]
    kept = 1.0 - 0.5 * (a * a + b * b + c * c)
    for j in range(3):
        x, y, z = rotation[0, j], rotation[1, j], rotation[2, j]
        along = 0.5 * (a * x + b * y + c * z)
        rotation[0, j] = kept * x + b * z - c * y + along * a
        rotation[1, j] = kept * y + c * x - a * z + along * b
        rotation[2, j] = kept * z + a * y - b * x + along * c
