"""Linear algebra of small matrices by numpy and MuJoCo: fastest if functions are not compiled."""

from __future__ import annotations

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array, exp, rotation_from_quaternion


def times(A: Array, x: Array, out: Array) -> None:
    """out (m,) = A (m, n) x (n,), in any unit."""
    np.dot(A, x, out=out)


def transposed_times(A: Array, x: Array, out: Array) -> None:
    """out (n,) = A^T x for A (m, n) and x (m,), in any unit."""
    np.dot(x, A, out=out)


def product(A: Array, B: Array, out: Array) -> None:
    """out (m, n) = A (m, k) B (k, n), in any unit."""
    np.dot(A, B, out=out)


def copy_matrix(A: Array, out: Array) -> None:
    """out (m, n) = A (m, n), in any unit."""
    out[:] = A


def copy_vector(x: Array, out: Array) -> None:
    """out (n,) = x (n,), in any unit."""
    out[:] = x


def squared(x: Array) -> float:
    """Return the sum of the squares of x (n,), in any unit: not finite if one of them is not."""
    return float(np.dot(x, x))


def cross(a: Array, b: Array, out: Array) -> None:
    """out (3,) = a x b (3,), along the same axes and in any unit."""
    mujoco.mju_cross(out, a, b)


def cholesky(A: Array) -> None:
    """Replace A (n, n), positive definite and in any unit, by its lower factor L, A = L L^T; the part above is kept."""
    mujoco.mju_cholFactor(A, 0.0)


def cholesky_solve(L: Array, b: Array, out: Array) -> None:
    """Solve L L^T out = b for L (n, n) and b (n,), in any unit."""
    mujoco.mju_cholSolve(out, L, b)


def rotation_by(vector: Array, out: Array) -> None:
    """out (3, 3) = the rotation about a vector (3,) in rad of the same frame."""
    out[:] = exp(vector)


def rotation_of(quaternion: Array, out: Array) -> None:
    """out (3, 3) = the rotation of a quaternion (4,), (w, x, y, z), no unit, in the same frame."""
    out[:] = rotation_from_quaternion(quaternion)


def rotation_between(start: Array, end: Array, out: Array) -> None:
    """out (3,) = log(end start^T): the rotation vector in rad between rotations (3, 3), in their parent frame."""
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.dot(end, start.T).ravel())
    mujoco.mju_quat2Vel(out, quaternion, 1.0)


def add_under(
    grid: Array, x: Array, y: Array, middle: Array, axes: Array, size: Array, amount: float, near: float
) -> None:
    """Add `amount` to the points of a grid (m, n), with rows y (m,) and columns x (n,), that are under a rectangle.

    Lengths in m. The grid lies in the plane z = 0. The rectangle has its centre `middle` (3,) and a size (2,) along the
    first columns of axes (3, 3), all in the frame of the grid; points at most `near` below it count.
    """
    reach = np.hypot(size[0], size[1]) / 2
    left, right = np.searchsorted(x, (middle[0] - reach, middle[0] + reach))
    low, high = np.searchsorted(y, (middle[1] - reach, middle[1] + reach))
    dx, dy = x[left:right] - middle[0], y[low:high, None] - middle[1]
    along, across = axes[0, 0] * dx + axes[1, 0] * dy, axes[0, 1] * dx + axes[1, 1] * dy
    inside = (np.abs(along) <= size[0] / 2) & (np.abs(across) <= size[1] / 2)
    height = middle[2] + axes[2, 0] * along + axes[2, 1] * across
    grid[low:high, left:right] += amount * (inside & (height <= near))
