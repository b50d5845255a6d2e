"""Poses and rotations: SI units, rotation matrices inside, quaternions (w, x, y, z) at interfaces."""

from __future__ import annotations

from math import atan2, cos, hypot, sin, sqrt
from typing import TypeAlias

import msgspec

from skillc_runtime.motion.arrays import Array as Array
from skillc_runtime.motion.arrays import Matrix, Vector, np

PoseNumbers: TypeAlias = tuple[float, float, float, float, float, float, float]


class Pose(msgspec.Struct, frozen=True):
    """A frame in a parent frame: `position` (3,) in m, `rotation` (3, 3), its columns are the axes in the parent."""

    position: Vector
    rotation: Matrix

    def __matmul__(self, other: Pose) -> Pose:
        """Return `other`, which is given in this frame, in the parent frame."""
        return Pose(self.rotation @ other.position + self.position, self.rotation @ other.rotation)

    def inverse(self) -> Pose:
        """Return the pose of the parent in this frame."""
        return Pose(-self.rotation.T @ self.position, self.rotation.T.copy())

    def apply(self, point: Array) -> Array:
        """Return a point (3,) in m of this frame in the parent frame."""
        return self.rotation @ point + self.position

    @property
    def numbers(self) -> PoseNumbers:
        """The position (x, y, z) in m and the quaternion (w, x, y, z)."""
        x, y, z = self.position.tolist()
        return (x, y, z, *quaternion_from_rotation(self.rotation).tolist())

    @staticmethod
    def of(position: Array | tuple[float, ...], quaternion: Array | tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)) -> Pose:
        """Return the pose of a position (3,) in m and a quaternion (4,), (w, x, y, z), of any norm above zero."""
        return Pose(np.array(position, dtype=float), rotation_from_quaternion(np.array(quaternion, dtype=float)))


def rotation_from_quaternion(quaternion: Array) -> Array:
    """Return the rotation (3, 3), from a frame to its parent, of a quaternion (4,), (w, x, y, z), normalised or not."""
    w, x, y, z = quaternion.tolist()
    s = 2 / (w * w + x * x + y * y + z * z)
    return np.array(
        [
            [1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)],
        ]
    )


def rotation_from_angles(roll: float, pitch: float, yaw: float) -> Array:
    """Return the rotation (3, 3), from a frame to its parent, of angles about the axes of the parent.

    R = Rz(yaw) Ry(pitch) Rx(roll): first about x, then about y, then about z, as in URDF, SDF and ROS (REP 103).
    roll: rad, about x.
    pitch: rad, about y.
    yaw: rad, about z.
    """
    a, b, c = roll / 2, pitch / 2, yaw / 2
    return rotation_from_quaternion(
        np.array(
            [
                cos(a) * cos(b) * cos(c) + sin(a) * sin(b) * sin(c),
                sin(a) * cos(b) * cos(c) - cos(a) * sin(b) * sin(c),
                cos(a) * sin(b) * cos(c) + sin(a) * cos(b) * sin(c),
                cos(a) * cos(b) * sin(c) - sin(a) * sin(b) * cos(c),
            ]
        )
    )


def angles_from_rotation(rotation: Array) -> tuple[float, float, float]:
    """Return roll, pitch and yaw in rad, about the axes of the parent, of a rotation (3, 3) of a frame.

    Roll is 0 if pitch is a right angle: only the sum or difference of roll and yaw is known then.
    """
    (a, b, _), (d, e, _), (g, h, i) = rotation.tolist()
    upright = hypot(a, d)
    if upright < 1e-9:
        return 0.0, atan2(-g, upright), atan2(-b, e)
    return atan2(h, i), atan2(-g, upright), atan2(d, a)


def quaternion_from_rotation(rotation: Array) -> Array:
    """Return the unit quaternion (4,), (w, x, y, z), with w >= 0 of a rotation (3, 3) of a frame. Shepperd's method."""
    (a, b, c), (d, e, f), (g, h, i) = rotation.tolist()
    rows = (
        (1 + a + e + i, h - f, c - g, d - b),
        (h - f, 1 + a - e - i, b + d, c + g),
        (c - g, b + d, 1 - a + e - i, f + h),
        (d - b, c + g, f + h, 1 - a - e + i),
    )
    largest = max(range(4), key=lambda k: rows[k][k])
    scale = 2 * sqrt(rows[largest][largest])
    return np.array(rows[largest]) / (scale if rows[largest][0] >= 0 else -scale)


def exp(rotation_vector: Array) -> Array:
    """Return the rotation (3, 3) about `rotation_vector` (3,) in rad, both in the same frame. Rodrigues' formula."""
    x, y, z = rotation_vector.tolist()
    angle = sqrt(x * x + y * y + z * z)
    if angle < 1e-12:
        return np.eye(3) + skew(rotation_vector)
    s, c = sin(angle) / angle, 2 * (sin(angle / 2) / angle) ** 2
    return np.array(
        [
            [1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y],
            [c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x],
            [c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y)],
        ]
    )


def log(rotation: Array) -> Array:
    """Return the rotation vector (3,) in rad, |angle| <= pi, of a rotation (3, 3), both in the same frame."""
    q = quaternion_from_rotation(rotation)
    sine = float(np.linalg.norm(q[1:]))
    if sine < 1e-12:
        return 2 * q[1:]
    return np.asarray(2 * atan2(sine, q[0]) / sine * q[1:])


def skew(v: Array) -> Array:
    """Return the matrix (3, 3) of the cross product with v (3,), along the same axes and in any unit."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
