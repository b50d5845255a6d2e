"""An arm as a chain of joints, in numbers: where each joint is on the one before, and how heavy what it moves is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, sin
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.pose import Array, Pose


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """The joints of an arm from its base to its tool, all at 0; each moves about, or along, z of its own frame.

    frames (nv, 12): the pose of each joint in the frame of the one before it, the first one's in the arm's base, as
    position in m and rotation by rows; slides (nv,): 1 for a joint that slides, else 0; tool (12,): the tool centre
    point in the frame of the last joint; masses (nv,) in kg, centres (nv, 3) in m: of what moves with each joint but
    not with the next, in its frame.
    """

    frames: Matrix
    slides: Vector
    tool: Vector
    masses: Vector
    centres: Matrix

    @property
    def joints(self) -> int:
        """The number of joints."""
        return len(self.slides)

    def with_tool(self, tool: Pose) -> Chain:
        """Return the chain with another tool centre point, given in the base with all joints at 0."""
        return replace(self, tool=pack(self.place_last(np.zeros(self.joints)).inverse() @ tool))

    def place_tool(self, q: Array) -> Pose:
        """Return where the tool is in base at joints q (nv,) in rad or m."""
        return self.place_last(q) @ unpack(self.tool)

    def place_last(self, q: Array) -> Pose:
        """Return where the frame of the last joint is in base at joints q (nv,) in rad or m."""
        at = np.empty((self.joints + 1, 12))
        place_joints(self, q, at)
        return unpack(at[self.joints - 1])


def read_chain(model: Any, end: str, payload_kg: float = 0.0) -> Chain:
    """Return the chain from the world of a MuJoCo model to its site or body `end`, where the tool is.

    `payload_kg` is a mass at the tool. KeyError if the model has no such site or body; ValueError if the joints on the
    way are not those of the model, in its order, or one neither turns nor slides.
    """
    data = mujoco.MjData(model)
    data.qpos[:] = 0.0
    mujoco.mj_kinematics(model, data)
    tool, body = _find_end(model, data, end)
    joints = _joints_on_way(model, body)
    zero = [_frame_of(data.xanchor[j], data.xaxis[j]) for j in joints]
    frames = [pack(before.inverse() @ here) for before, here in zip([Pose.of((0, 0, 0)), *zero], zero, strict=False)]
    slides = [float(model.jnt_type[j] == mujoco.mjtJoint.mjJNT_SLIDE) for j in joints]
    masses, centres = _masses(model, data, joints, zero)
    last = len(joints) - 1
    at_tool = zero[-1].inverse() @ tool
    whole = masses[last] + payload_kg
    if whole > 0.0:
        centres[last] = (masses[last] * centres[last] + payload_kg * at_tool.position) / whole
    masses[last] = whole
    return Chain(np.array(frames), np.array(slides), pack(at_tool), masses, centres)


def pack(pose: Pose) -> Array:
    """Return a pose as numbers (12,), in its frame: position in m, rotation by rows."""
    return np.concatenate([pose.position, pose.rotation.ravel()])


def unpack(numbers: Array) -> Pose:
    """Return the pose that numbers (12,) are, in their frame: position in m, rotation by rows."""
    return Pose(numbers[:3].copy(), numbers[3:].reshape(3, 3).copy())


@compiled
def place_joints(chain: Chain, q: Vector, at: OutMatrix) -> None:
    """at (nv + 1, 12) = the poses in base of all joints, moved by q (nv,) in rad or m, and of the tool."""
    place(chain.frames, chain.slides, chain.tool, q, at)


@inlined
def place(frames: Array, slides: Array, tool: Array, q: Array, at: Array) -> None:
    """Compute the poses of joints and tool in base, as in `place_joints`.

    frames: (nv, 12) in m, of each joint in the one before it.
    slides: (nv,), 1 for a joint that slides, else 0; no unit.
    tool: (12,) in m, its pose in the last joint.
    q: (nv,) in rad or m, the joints.
    at: (nv + 1, 12) in m, in base; it is written.
    """
    n = slides.size
    for i in range(n + 1):
        for r in range(3):
            for c in range(3):
                if i == 0:
                    at[i, 3 + 3 * r + c] = frames[0, 3 + 3 * r + c]
                else:
                    total = 0.0
                    for k in range(3):
                        total += at[i - 1, 3 + 3 * r + k] * (frames[i, 3 + 3 * k + c] if i < n else tool[3 + 3 * k + c])
                    at[i, 3 + 3 * r + c] = total
            if i == 0:
                at[i, r] = frames[0, r]
            else:
                total = at[i - 1, r]
                for k in range(3):
                    total += at[i - 1, 3 + 3 * r + k] * (frames[i, k] if i < n else tool[k])
                at[i, r] = total
        if i < n:
            if slides[i] > 0.5:
                for r in range(3):
                    at[i, r] += q[i] * at[i, 5 + 3 * r]
            else:
                cosine, sine = cos(q[i]), sin(q[i])
                for r in range(3):
                    x, y = at[i, 3 + 3 * r], at[i, 4 + 3 * r]
                    at[i, 3 + 3 * r] = cosine * x + sine * y
                    at[i, 4 + 3 * r] = cosine * y - sine * x


@inlined
def differentiate(slides: Array, at: Array, jacobian: Array) -> None:
    """Compute the Jacobian of the tool from the poses of joints and tool.

    slides: (nv,), 1 for a joint that slides, else 0; no unit.
    at: (nv + 1, 12) in m, in base.
    jacobian: (6, nv), [linear m; angular rad] per rad or m, base axes; it is written.
    """
    n = slides.size
    for i in range(n):
        zx, zy, zz = at[i, 5], at[i, 8], at[i, 11]
        if slides[i] > 0.5:
            jacobian[0, i], jacobian[1, i], jacobian[2, i] = zx, zy, zz
            jacobian[3, i], jacobian[4, i], jacobian[5, i] = 0.0, 0.0, 0.0
        else:
            x, y, z = at[n, 0] - at[i, 0], at[n, 1] - at[i, 1], at[n, 2] - at[i, 2]
            jacobian[0, i], jacobian[1, i], jacobian[2, i] = zy * z - zz * y, zz * x - zx * z, zx * y - zy * x
            jacobian[3, i], jacobian[4, i], jacobian[5, i] = zx, zy, zz


@inlined
def add_weight(slides: Array, masses: Array, centres: Array, at: Array, gravity: Array, torques: Array) -> None:
    """Compute what the joints exert to bear masses, from poses of joints and tool.

    slides: (nv,), 1 for a joint that slides, else 0; no unit.
    masses: (nv,) in kg, of each link.
    centres: (nv, 3) in m, of each mass in the frame of its joint.
    at: (nv + 1, 12) in m, in base.
    gravity: (3,) in m/s^2, in base.
    torques: (nv,) in N m or N; it is written.
    """
    n = slides.size
    mass, mx, my, mz = 0.0, 0.0, 0.0, 0.0
    gx, gy, gz = gravity[0], gravity[1], gravity[2]
    for i in range(n - 1, -1, -1):
        x, y, z = centres[i, 0], centres[i, 1], centres[i, 2]
        mass += masses[i]
        mx += masses[i] * (at[i, 0] + at[i, 3] * x + at[i, 4] * y + at[i, 5] * z)
        my += masses[i] * (at[i, 1] + at[i, 6] * x + at[i, 7] * y + at[i, 8] * z)
        mz += masses[i] * (at[i, 2] + at[i, 9] * x + at[i, 10] * y + at[i, 11] * z)
        zx, zy, zz = at[i, 5], at[i, 8], at[i, 11]
        if slides[i] > 0.5:
            torques[i] = -mass * (zx * gx + zy * gy + zz * gz)
        else:
            rx, ry, rz = mx - mass * at[i, 0], my - mass * at[i, 1], mz - mass * at[i, 2]
            torques[i] = -(zx * (ry * gz - rz * gy) + zy * (rz * gx - rx * gz) + zz * (rx * gy - ry * gx))


def _find_end(model: Any, data: Any, end: str) -> tuple[Pose, int]:
    """Return the pose of a site, or else of a body, and the body that it is on."""
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, end)
    if site >= 0:
        return Pose(data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy()), int(
            model.site_bodyid[site]
        )
    body = model.body(end).id
    return Pose(data.xpos[body].copy(), data.xmat[body].reshape(3, 3).copy()), int(body)


def _joints_on_way(model: Any, body: int) -> list[int]:
    joints: list[int] = []
    while body > 0:
        first = int(model.body_jntadr[body])
        joints = [*range(first, first + int(model.body_jntnum[body])), *joints]
        body = int(model.body_parentid[body])
    kinds = {int(model.jnt_type[j]) for j in joints}
    if not joints or joints != list(range(len(joints))):
        raise ValueError("the joints on the way to the tool are not the first ones of the model")
    if not kinds <= {int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)}:
        raise ValueError("an arm has joints that turn or slide")
    return joints


def _frame_of(origin: Array, axis: Array) -> Pose:
    """Return a frame at a point (3,) m whose z axis is a unit vector (3,)."""
    near = np.eye(3)[int(np.abs(axis).argmin())]
    x = np.cross(near, axis)
    x /= np.linalg.norm(x)
    return Pose(origin.copy(), np.column_stack([x, np.cross(axis, x), axis]))


def _masses(model: Any, data: Any, joints: list[int], zero: list[Pose]) -> tuple[Array, Array]:
    """Return the masses (nv,) in kg and centres (nv, 3) in m of what moves with each joint but not with the next."""
    masses, moments = np.zeros(len(joints)), np.zeros((len(joints), 3))
    for body in range(1, model.nbody):
        mover = _last_joint(model, body, joints)
        if mover is not None:
            masses[mover] += model.body_mass[body]
            moments[mover] += model.body_mass[body] * zero[mover].inverse().apply(data.xipos[body])
    heavy = np.maximum(masses, 1e-12)[:, None]
    return masses, moments / heavy


def _last_joint(model: Any, body: int, joints: list[int]) -> int | None:
    """Return the last joint of the chain that moves a body, by its place in the chain; None if none does."""
    while body > 0:
        first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
        if count and first + count - 1 in joints:
            return joints.index(first + count - 1)
        body = int(model.body_parentid[body])
    return None
