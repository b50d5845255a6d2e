"""Where the controller of a UR5e says that its flange is: the maker's Denavit-Hartenberg parameters, in m and rad."""

from __future__ import annotations

from math import acos, cos, pi, sin

import numpy as np

D = (0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996)
A = (0.0, -0.425, -0.3922, 0.0, 0.0, 0.0)
ALPHA = (pi / 2, 0.0, 0.0, pi / 2, -pi / 2, 0.0)
"""Published by Universal Robots for the UR5e; a real arm has calibrated ones beside them."""


def flange_pose(q: np.ndarray) -> np.ndarray:
    """Return the flange (4, 4) in the controller's base for q (6,) in rad."""
    pose = np.eye(4)
    for angle, d, a, alpha in zip(q, D, A, ALPHA, strict=True):
        c, s, ca, sa = cos(angle), sin(angle), cos(alpha), sin(alpha)
        pose = pose @ np.array(
            [
                [c, -s * ca, s * sa, a * c],
                [s, c * ca, -c * sa, a * s],
                [0.0, sa, ca, d],
                [0.0, 0.0, 0.0, 1.0],
            ]
        )
    return pose


def write_pose(flange: np.ndarray, offset: np.ndarray) -> list[float]:
    """Return a point at an offset (3,) in m on a flange (4, 4), as controllers write poses: m and rotation vector."""
    point = flange[:3, 3] + flange[:3, :3] @ offset
    return [*point.tolist(), *rotation_vector(flange[:3, :3]).tolist()]


def rotation_vector(rotation: np.ndarray) -> np.ndarray:
    """Return the rotation (3,) about its axis in rad, as controllers write orientations, of a matrix (3, 3)."""
    angle = acos(min(max((np.trace(rotation) - 1.0) / 2.0, -1.0), 1.0))
    if angle < 1e-9:
        return np.zeros(3)
    if angle > pi - 1e-4:
        axis = np.sqrt(np.maximum((rotation.diagonal() + 1.0) / 2.0, 0.0))
        largest = int(np.argmax(axis))
        signs = np.sign(rotation[largest] + rotation[:, largest])
        signs[largest] = 1.0
        return angle * axis * np.where(signs == 0.0, 1.0, signs)
    skew = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    return angle / (2.0 * sin(angle)) * skew
