"""Kinematics and dynamics of a virtual arm as numbers: what `VirtualArm` lets MuJoCo compute, for compiled laws.

Each body is a point of mass m at its origin with an isotropic inertia I, so with the Jacobians J_v, J_w of the origins
M = sum m J_v^T J_v + I J_w^T J_w;  c = sum m J_v^T a + I J_w^T alpha, a and alpha without joint accelerations.
"""

from __future__ import annotations

from math import cos, sin
from typing import Any

import msgspec
import mujoco
import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import copy_matrix, copy_vector, product
from skillc_runtime.motion.pose import Array, rotation_from_quaternion

PARENT, MASS, INERTIA, FIRST_JOINT, JOINTS = range(5)
PLACE, AXES, BODY_SIZE = 5, 8, 17
"""Columns of `VirtualChain.bodies`: parent, kg, kg m^2, first joint and number of joints; then the frame in that of the
parent: position (3,) in m and rotation, row by row (9,)."""

SLIDES, ZERO = 0, 1
AXIS, ANCHOR, JOINT_SIZE = 2, 5, 8
"""Columns of `VirtualChain.joints`: 1 if it slides, its value where the frame is that of the body; unit axis (3,) and
anchor (3,) m, in the frame of the body."""

POSITION, SPIN, TURNING, PULL = 0, 1, 2, 3
"""Rows of the motion of a body: position in m, angular velocity in rad/s, angular acceleration, acceleration."""


class VirtualChain(msgspec.Struct, frozen=True):
    """A tree of bodies with joints, one a row, parents first; body 0 is the base. The tool is the origin of the last.

    moved (n, nv): 1 where a joint moves a body. axes, anchors (nv, 3): in base, written by `compute_virtual`.
    """

    bodies: OutMatrix
    joints: Matrix
    moved: Matrix
    axes: OutMatrix
    anchors: OutMatrix


def make_chain(model: Any, tool: int) -> VirtualChain:
    """Return the chain of a virtual model, whose joints turn or slide; `tool` is its last body."""
    assert tool == model.nbody - 1
    bodies = np.zeros((model.nbody, BODY_SIZE))
    bodies[:, PARENT], bodies[:, MASS], bodies[:, INERTIA] = (
        model.body_parentid,
        model.body_mass,
        model.body_inertia[:, 0],
    )
    bodies[:, FIRST_JOINT], bodies[:, JOINTS] = model.body_jntadr, model.body_jntnum
    joints, moved = np.zeros((model.nv, JOINT_SIZE)), np.zeros((model.nbody, model.nv))
    joints[:, SLIDES], joints[:, ZERO] = model.jnt_type == mujoco.mjtJoint.mjJNT_SLIDE, model.qpos0
    joints[:, AXIS:ANCHOR], joints[:, ANCHOR:] = model.jnt_axis, model.jnt_pos
    for body in range(1, model.nbody):
        moved[body] = moved[model.body_parentid[body]]
        moved[body, model.jnt_bodyid == body] = 1.0
    chain = VirtualChain(bodies, joints, moved, np.zeros((model.nv, 3)), np.zeros((model.nv, 3)))
    for body in range(model.nbody):
        place_body(chain, body, model.body_pos[body], model.body_quat[body])
    return chain


def place_body(chain: VirtualChain, body: int, position: Array, quaternion: Array) -> None:
    """Place the frame of a body in that of its parent: position (3,) in m, quaternion (4,)."""
    chain.bodies[body, PLACE:AXES] = position
    chain.bodies[body, AXES:] = rotation_from_quaternion(quaternion).ravel()


@inlined
def _turn(rotation: Array, axis: Array, angle: float) -> None:
    """Turn a frame (3, 3) about a unit axis (3,) in its own axes: R <- R Exp(angle axis)."""
    s, c = sin(angle), cos(angle)
    x, y, z, d = axis[0], axis[1], axis[2], 1 - c
    for i in range(3):
        a, b, e = rotation[i, 0], rotation[i, 1], rotation[i, 2]
        along = d * (a * x + b * y + e * z)
        rotation[i, 0] = c * a + along * x + s * (b * z - e * y)
        rotation[i, 1] = c * b + along * y + s * (e * x - a * z)
        rotation[i, 2] = c * e + along * z + s * (a * y - b * x)


@inlined
def _carry(motion: Array, x: float, y: float, z: float) -> None:
    """Move the point of a body's motion by a way r in m that is fixed in the body: a += alpha x r + w x (w x r)."""
    p, q, r = motion[SPIN, 0], motion[SPIN, 1], motion[SPIN, 2]
    a, b, c = motion[TURNING, 0], motion[TURNING, 1], motion[TURNING, 2]
    u, v, w = q * z - r * y, r * x - p * z, p * y - q * x
    motion[POSITION, 0] += x
    motion[POSITION, 1] += y
    motion[POSITION, 2] += z
    motion[PULL, 0] += b * z - c * y + (q * w - r * v)
    motion[PULL, 1] += c * x - a * z + (r * u - p * w)
    motion[PULL, 2] += a * y - b * x + (p * v - q * u)


@inlined
def _rotated(rotation: Array, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return a vector of a frame with a rotation (3, 3) along the axes of its parent."""
    return (
        rotation[0, 0] * x + rotation[0, 1] * y + rotation[0, 2] * z,
        rotation[1, 0] * x + rotation[1, 1] * y + rotation[1, 2] * z,
        rotation[2, 0] * x + rotation[2, 1] * y + rotation[2, 2] * z,
    )


@inlined
def _move_joint(chain: VirtualChain, joint: int, motion: Array, rotation: Array, q: float, dq: float) -> None:
    """Move a body by one of its joints, which turns or slides by q from its zero with the speed dq."""
    numbers, axis, anchor = chain.joints[joint], chain.axes[joint], chain.anchors[joint]
    away, spin, turning = q - numbers[ZERO], motion[SPIN], motion[TURNING]
    x, y, z = _rotated(rotation, numbers[AXIS], numbers[AXIS + 1], numbers[AXIS + 2])
    axis[0], axis[1], axis[2] = x, y, z
    u, v, w = spin[1] * z - spin[2] * y, spin[2] * x - spin[0] * z, spin[0] * y - spin[1] * x
    if numbers[SLIDES] != 0.0:
        _carry(motion, away * x, away * y, away * z)
        motion[PULL, 0] += 2 * dq * u
        motion[PULL, 1] += 2 * dq * v
        motion[PULL, 2] += 2 * dq * w
        return
    to_x, to_y, to_z = _rotated(rotation, numbers[ANCHOR], numbers[ANCHOR + 1], numbers[ANCHOR + 2])
    _carry(motion, to_x, to_y, to_z)
    for i in range(3):
        anchor[i] = motion[POSITION, i]
        spin[i] += dq * axis[i]
    turning[0] += dq * u
    turning[1] += dq * v
    turning[2] += dq * w
    _turn(rotation, numbers[AXIS:ANCHOR], away)
    to_x, to_y, to_z = _rotated(rotation, -numbers[ANCHOR], -numbers[ANCHOR + 1], -numbers[ANCHOR + 2])
    _carry(motion, to_x, to_y, to_z)


@inlined
def _fill_jacobian(chain: VirtualChain, body: int, point: Array, J: Array) -> None:
    """Compute the Jacobian (6, nv) of a point (3,) m of a body, [linear; angular], in base."""
    for j in range(chain.joints.shape[0]):
        x, y, z = chain.axes[j, 0], chain.axes[j, 1], chain.axes[j, 2]
        moves = chain.moved[body, j]
        if chain.joints[j, SLIDES] != 0.0:
            J[0, j], J[1, j], J[2, j] = moves * x, moves * y, moves * z
            J[3, j], J[4, j], J[5, j] = 0.0, 0.0, 0.0
            continue
        a, b, c = point[0] - chain.anchors[j, 0], point[1] - chain.anchors[j, 1], point[2] - chain.anchors[j, 2]
        J[0, j], J[1, j], J[2, j] = moves * (y * c - z * b), moves * (z * a - x * c), moves * (x * b - y * a)
        J[3, j], J[4, j], J[5, j] = moves * x, moves * y, moves * z


@inlined
def _add_body(chain: VirtualChain, body: int, motion: Array, J: Array, inertia: Array, bias: Array) -> None:
    """Add what a body contributes to inertia (nv, nv) and bias (nv,)."""
    mass, turning = chain.bodies[body, MASS], chain.bodies[body, INERTIA]
    for i in range(bias.size):
        if chain.moved[body, i] == 0.0:
            continue
        for k in range(3):
            bias[i] += mass * J[k, i] * motion[PULL, k] + turning * J[3 + k, i] * motion[TURNING, k]
        for j in range(i + 1):
            total = 0.0
            for k in range(3):
                total += mass * J[k, i] * J[k, j] + turning * J[3 + k, i] * J[3 + k, j]
            inertia[i, j] += total


@inlined
def _clear(inertia: Array, bias: Array) -> None:
    for i in range(bias.size):
        bias[i] = 0.0
        for j in range(bias.size):
            inertia[i, j] = 0.0


@inlined
def _move_body(chain: VirtualChain, body: int, motions: Array, rotations: Array, q: Array, dq: Array) -> None:
    """Compute the motion (4, 3) and the rotation (3, 3) of a body, in base, from those of its parent."""
    numbers, motion, turned = chain.bodies[body], motions[body], rotations[body]
    parent, first = int(numbers[PARENT]), int(numbers[FIRST_JOINT])
    copy_matrix(motions[parent], motion)
    x, y, z = _rotated(rotations[parent], numbers[PLACE], numbers[PLACE + 1], numbers[PLACE + 2])
    _carry(motion, x, y, z)
    product(rotations[parent], numbers[AXES:].reshape(3, 3), turned)
    for joint in range(first, first + int(numbers[JOINTS])):
        _move_joint(chain, joint, motion, turned, q[joint], dq[joint])


@inlined
def compute_virtual(
    chain: VirtualChain, q: Array, dq: Array, position: Array, rotation: Array, J: Array, inertia: Array, bias: Array
) -> None:
    """Compute the tool, its Jacobian, inertia and bias, all in base, for joints with speeds; see `VirtualState`.

    q: (nv,) in rad.
    dq: (nv,) in rad/s.
    position: (3,) in m; it is written, as are those below.
    rotation: (3, 3), rotation (3, 3) from tool to base.
    J: (6, nv), m and rad per rad, base axes.
    inertia: (nv, nv) in kg m^2.
    bias: (nv,) in N m.
    """
    count = chain.bodies.shape[0]
    motions, rotations = np.zeros((count, 4, 3)), np.zeros((count, 3, 3))
    _clear(inertia, bias)
    for i in range(3):
        rotations[0, i, i] = 1.0
    for body in range(1, count):
        _move_body(chain, body, motions, rotations, q, dq)
        if chain.bodies[body, MASS] > 0.0:
            _fill_jacobian(chain, body, motions[body, POSITION], J)
            _add_body(chain, body, motions[body], J, inertia, bias)
    for i in range(bias.size):
        for j in range(i):
            inertia[j, i] = inertia[i, j]
    copy_vector(motions[count - 1, POSITION], position)
    copy_matrix(rotations[count - 1], rotation)
