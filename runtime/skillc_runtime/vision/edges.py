"""Aligns a believed rectangle with the edges that an image shows near it.

Harris & Stennett, RAPID, a video rate object tracker, 1990: steps across believed edges, then a pose of least squares.
"""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.vision.inspected_surface import InspectedSurface
from skillc_runtime.vision.lens import Lens, project
from skillc_runtime.vision.markers import Image
from skillc_runtime.vision.opencv import load_opencv

POINTS = 40
"""Points along each edge."""

REACH_PX = (24, 12, 6, 4, 4)
"""How far across an edge a step is looked for, in each round."""

LEAST_STEP = 12.0
"""Values to 255 by which brightness changes at an edge."""

LEAST_SHARE = 0.4
"""Share of the points of each edge that must show a step."""

OUTLIER_PX = 2.0
"""The scale of errors from which on points count less."""


def align_edges(image: Image, lens: Lens, surface: InspectedSurface, believed: Pose) -> tuple[Pose, float] | None:
    """Return the pose of a surface in the frame of the camera, the RMS error in pixels; None without clear edges."""
    cv2 = load_opencv()
    grey = cv2.GaussianBlur(cv2.cvtColor(image, cv2.COLOR_RGB2GRAY).astype(np.float32), (0, 0), 1.0)
    starts, share = surface.corners, (np.arange(POINTS) + 0.5) / POINTS
    ends = np.roll(starts, -1, axis=0)
    points = (starts[:, None] + share[None, :, None] * (ends - starts)[:, None]).reshape(-1, 3)
    along = np.repeat(ends - starts, POINTS, axis=0)
    pose, error = believed, np.inf
    for reach in REACH_PX:
        pixels, normals = _normals(lens, pose, points, along)
        away, seen = _steps(grey, pixels, normals, reach)
        if (seen.reshape(4, POINTS).mean(axis=1) < LEAST_SHARE).any():
            return None
        pose = _move(lens, pose, points, normals, away, seen)
        near = np.abs(away[seen]) < reach / 2
        error = float(np.sqrt(np.mean(away[seen][near] ** 2))) if near.any() else np.inf
    return pose, error


def _normals(lens: Lens, pose: Pose, points: Array, along: Array) -> tuple[Array, Array]:
    """Return the pixels (n, 2) of points and the unit normals (n, 2) of the edges there, in the image."""
    pixels = project(lens, pose, points)
    step = project(lens, pose, points + 1e-3 * along) - pixels
    step /= np.linalg.norm(step, axis=1, keepdims=True)
    return pixels, np.stack([-step[:, 1], step[:, 0]], axis=1)


def _steps(grey: Array, pixels: Array, normals: Array, reach: int) -> tuple[Array, Array]:
    """Return how far along its normal each point (n,) has the steepest step, in pixels, and whether there is one."""
    cv2 = load_opencv()
    offsets = np.arange(-reach - 1, reach + 2, dtype=float)
    at = (pixels[:, None] + offsets[None, :, None] * normals[:, None]).astype(np.float32)
    values = cv2.remap(grey, at[..., 0], at[..., 1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    slope = np.abs(values[:, 2:] - values[:, :-2]) / 2
    best = np.clip(slope.argmax(axis=1), 1, slope.shape[1] - 2)
    rows = np.arange(len(best))
    low, middle, high = slope[rows, best - 1], slope[rows, best], slope[rows, best + 1]
    bend = low - 2 * middle + high
    part = np.where(bend < 0, 0.5 * (low - high) / np.where(bend < 0, bend, 1.0), 0.0)
    height, width = grey.shape
    inside = (pixels > 1).all(axis=1) & (pixels[:, 0] < width - 2) & (pixels[:, 1] < height - 2)
    return best - reach + np.clip(part, -1.0, 1.0), inside & (middle > LEAST_STEP / 2)


def _move(lens: Lens, pose: Pose, points: Array, normals: Array, away: Array, seen: Array) -> Pose:
    """Return the pose after steps of Gauss-Newton; those far from the others count less (Cauchy weights)."""
    here, columns, small = project(lens, pose, points), [], 1e-5
    for axis in np.eye(6):
        moved = Pose(pose.position + small * axis[:3], exp(small * axis[3:]) @ pose.rotation)
        columns.append((((project(lens, moved, points) - here) / small) * normals).sum(axis=1))
    J = np.stack(columns, axis=1)[seen]
    step = np.zeros(6)
    for _ in range(6):
        weights = 1.0 / (1.0 + ((away[seen] - J @ step) / OUTLIER_PX) ** 2)
        A = J.T @ (weights[:, None] * J)
        step = np.linalg.solve(A + 1e-6 * np.diag(np.diag(A)), J.T @ (weights * away[seen]))
    return Pose(pose.position + step[:3], exp(step[3:]) @ pose.rotation)
