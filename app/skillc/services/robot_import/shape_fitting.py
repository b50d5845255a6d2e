"""Fits the smallest of a box, a cylinder and a capsule around the vertices of a mesh."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc.services.robot_import.robot_model import Shape
from skillc_runtime.motion.pose import Array, Pose

THINNEST_M = 0.001
"""Least half edge and radius."""


def fit_shape(vertices: Array) -> Shape:
    """Return the box, cylinder or capsule of least volume that contains vertices (n, 3) in m, n > 0.

    The shapes lie along the axes of the link or along the principal axes of the vertices.
    """
    candidates = [each for axes in _axes(vertices) for each in _around(vertices, axes)]
    return min(candidates, key=volume)


def volume(shape: Shape) -> float:
    """Return the volume of a shape in m^3."""
    match shape.kind:
        case "box":
            return float(8 * np.prod(shape.size))
        case "sphere":
            return float(4 / 3 * np.pi * shape.size[0] ** 3)
        case _:
            radius, half = shape.size
            caps = 4 / 3 * np.pi * radius**3 if shape.kind == "capsule" else 0.0
            return float(2 * np.pi * radius**2 * half + caps)


def _axes(vertices: Array) -> Iterator[Array]:
    """Yield right-handed rotations (3, 3) whose z axis is each axis of the link, and each principal axis."""
    spread = vertices - vertices.mean(axis=0)
    principal = np.linalg.eigh(spread.T @ spread)[1]
    for frame in (np.eye(3), principal):
        for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            turned = frame[:, order]
            yield turned * np.array([1.0, 1.0, np.sign(np.linalg.det(turned))])


def _around(vertices: Array, axes: Array) -> Iterator[Shape]:
    """Yield the shapes around vertices whose z axis is the last column of `axes`."""
    inside = vertices @ axes
    low, high = inside.min(axis=0), inside.max(axis=0)
    middle, half = (low + high) / 2, np.maximum((high - low) / 2, THINNEST_M)
    pose = Pose(axes @ middle, axes)
    yield Shape("box", pose, tuple(half.tolist()))
    away = np.hypot(*(inside[:, :2] - middle[:2]).T)
    radius = max(float(away.max()), THINNEST_M)
    yield Shape("cylinder", pose, (radius, float(half[2])))
    yield Shape("capsule", pose, (radius, _straight_half(inside[:, 2] - middle[2], away, radius)))


def _straight_half(along: Array, away: Array, radius: float) -> float:
    """Return the least half length of the straight part of a capsule that contains points at heights and distances."""
    needed = np.abs(along) - np.sqrt(np.maximum(radius**2 - away**2, 0.0))
    return max(float(needed.max()), THINNEST_M)
