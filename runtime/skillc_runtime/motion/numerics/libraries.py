"""Linear algebra of small matrices by numpy and MuJoCo: fastest where every operation costs a call."""

from __future__ import annotations

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array, exp


def times(A: Array, x: Array, out: Array) -> None:
    """out (m,) = A (m, n) x (n,)."""
    np.dot(A, x, out=out)


def transposed_times(A: Array, x: Array, out: Array) -> None:
    """out (n,) = A^T x for A (m, n) and x (m,)."""
    np.dot(x, A, out=out)


def product(A: Array, B: Array, out: Array) -> None:
    """out (m, n) = A (m, k) B (k, n)."""
    np.dot(A, B, out=out)


def cross(a: Array, b: Array, out: Array) -> None:
    """out (3,) = a x b."""
    mujoco.mju_cross(out, a, b)


def cholesky(A: Array) -> None:
    """Turn A (n, n), symmetric and positive, into its lower factor L with A = L L^T; what is above stays."""
    mujoco.mju_cholFactor(A, 0.0)


def cholesky_solve(L: Array, b: Array, out: Array) -> None:
    """Solve L L^T out = b for b (n,)."""
    mujoco.mju_cholSolve(out, L, b)


def rotation_by(vector: Array, out: Array) -> None:
    """out (3, 3) = the rotation about a vector (3,) in rad."""
    out[:] = exp(vector)


def rotation_between(start: Array, end: Array, out: Array) -> None:
    """out (3,) = log(end start^T): the shortest turn in rad between rotations (3, 3), along their parent's axes."""
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.dot(end, start.T).ravel())
    mujoco.mju_quat2Vel(out, quaternion, 1.0)


def add_under(
    grid: Array, x: Array, y: Array, middle: Array, axes: Array, size: Array, amount: float, near: float
) -> None:
    """Add to the points of a grid (m, n), rows y (m,) and columns x (n,), that a rectangle reaches; in m.

    The grid lies in the plane z = 0. The rectangle has its middle (3,) and a size (2,) along the first columns of axes
    (3, 3), all in the grid's frame; it may reach to `near` above the plane.
    """
    reach = np.hypot(size[0], size[1]) / 2
    left, right = np.searchsorted(x, (middle[0] - reach, middle[0] + reach))
    low, high = np.searchsorted(y, (middle[1] - reach, middle[1] + reach))
    dx, dy = x[left:right] - middle[0], y[low:high, None] - middle[1]
    along, across = axes[0, 0] * dx + axes[1, 0] * dy, axes[0, 1] * dx + axes[1, 1] * dy
    inside = (np.abs(along) <= size[0] / 2) & (np.abs(across) <= size[1] / 2)
    height = middle[2] + axes[2, 0] * along + axes[2, 1] * across
    grid[low:high, left:right] += amount * (inside & (height <= near))
