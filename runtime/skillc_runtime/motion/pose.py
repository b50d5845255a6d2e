"""Rigid poses and rotations: SI units, rotation matrices inside, quaternions (w, x, y, z) at the edges."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, sin

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Pose:
    """A frame in a parent frame: `position` (3,) in m, `rotation` (3, 3), its columns are the axes in the parent."""

    position: Array
    rotation: Array

    def __matmul__(self, other: Pose) -> Pose:
        """Return `other`, given in this frame, in this frame's parent."""
        return Pose(self.rotation @ other.position + self.position, self.rotation @ other.rotation)

    def inverse(self) -> Pose:
        """Return the parent in this frame."""
        return Pose(-self.rotation.T @ self.position, self.rotation.T.copy())

    def at(self, point: Array) -> Array:
        """Return a point (3,) of this frame in the parent."""
        return self.rotation @ point + self.position

    @staticmethod
    def of(position: Array | tuple[float, ...], quaternion: Array | tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)) -> Pose:
        """Make a pose from a position in m and a quaternion (w, x, y, z) of any norm but zero."""
        return Pose(np.array(position, dtype=float), rotation_of(np.array(quaternion, dtype=float)))


def rotation_of(quaternion: Array) -> Array:
    """Return the rotation (3, 3) of a quaternion (w, x, y, z); it need not be normalised."""
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion_of(rotation: Array) -> Array:
    """Return the quaternion (w, x, y, z) of a rotation (3, 3), with w >= 0. Shepperd's method."""
    m = rotation
    squares = np.array(
        [
            1 + m[0, 0] + m[1, 1] + m[2, 2],
            1 + m[0, 0] - m[1, 1] - m[2, 2],
            1 - m[0, 0] + m[1, 1] - m[2, 2],
            1 - m[0, 0] - m[1, 1] + m[2, 2],
        ]
    )
    largest = int(np.argmax(squares))
    r = np.sqrt(squares[largest])
    skew = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    q = np.empty(4)
    if largest == 0:
        q[0], q[1:] = r / 2, skew / (2 * r)
    else:
        i = largest - 1
        j, k = (i + 1) % 3, (i + 2) % 3
        q[0] = skew[i] / (2 * r)
        q[1 + i], q[1 + j], q[1 + k] = r / 2, (m[j, i] + m[i, j]) / (2 * r), (m[k, i] + m[i, k]) / (2 * r)
    return q if q[0] >= 0 else -q


def exp(rotation_vector: Array) -> Array:
    """Return the rotation (3, 3) about a vector (3,) in rad. Rodrigues' formula."""
    angle = float(np.linalg.norm(rotation_vector))
    if angle < 1e-12:
        return np.eye(3) + skew(rotation_vector)
    axis = skew(rotation_vector / angle)
    rotation: Array = np.eye(3) + sin(angle) * axis + (1 - cos(angle)) * (axis @ axis)
    return rotation


def log(rotation: Array) -> Array:
    """Return the shortest rotation vector (3,) in rad, |angle| <= pi, of a rotation (3, 3)."""
    q = quaternion_of(rotation)
    sine = float(np.linalg.norm(q[1:]))
    if sine < 1e-12:
        return 2 * q[1:]
    return np.asarray(2 * atan2(sine, q[0]) / sine * q[1:])


def skew(v: Array) -> Array:
    """Return the matrix (3, 3) of the cross product v x."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
