"""Linear algebra of small matrices by numpy and MuJoCo: fastest if functions are not compiled."""

from __future__ import annotations

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array, exp, rotation_from_quaternion


def times(A: Array, x: Array, out: Array) -> None:
    """out = A x.

    A: (m, n), any unit.
    x: (n,), any unit.
    out: (m,), any unit; it is written.
    """
    np.dot(A, x, out=out)


def transposed_times(A: Array, x: Array, out: Array) -> None:
    """out = A^T x.

    A: (m, n), any unit.
    x: (m,), any unit.
    out: (n,), any unit; it is written.
    """
    np.dot(x, A, out=out)


def product(A: Array, B: Array, out: Array) -> None:
    """out = A B.

    A: (m, k), any unit.
    B: (k, n), any unit.
    out: (m, n), any unit; it is written.
    """
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
    """out = a x b, along the same axes.

    a: (3,), any unit.
    b: (3,), any unit.
    out: (3,), any unit; it is written.
    """
    mujoco.mju_cross(out, a, b)


def cholesky(A: Array) -> None:
    """Replace A (n, n), positive definite and in any unit, by its lower factor L, A = L L^T; the part above is kept."""
    mujoco.mju_cholFactor(A, 0.0)


def cholesky_solve(L: Array, b: Array, out: Array) -> None:
    """Solve L L^T out = b.

    L: (n, n), any unit.
    b: (n,), any unit.
    out: (n,), any unit; it is written.
    """
    mujoco.mju_cholSolve(out, L, b)


def rotation_by(vector: Array, out: Array) -> None:
    """out (3, 3) = the rotation about a vector (3,) in rad of the same frame."""
    out[:] = exp(vector)


def rotation_of(quaternion: Array, out: Array) -> None:
    """out (3, 3) = the rotation of a quaternion (4,), (w, x, y, z), no unit, in the same frame."""
    out[:] = rotation_from_quaternion(quaternion)


def rotation_between(start: Array, end: Array, out: Array) -> None:
    """out = log(end start^T): the rotation vector between rotations, in their parent frame.

    start: (3, 3), a rotation (3, 3).
    end: (3, 3), a rotation (3, 3).
    out: (3,) in rad; it is written.
    """
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, np.dot(end, start.T).ravel())
    mujoco.mju_quat2Vel(out, quaternion, 1.0)


def add_under(
    grid: Array, x: Array, y: Array, middle: Array, axes: Array, size: Array, amount: float, near: float
) -> None:
    """Add to the points of a grid that are under a rectangle. The grid lies in the plane z = 0 of its frame.

    grid: (m, n), any unit.
    x: (n,) in m, of the columns.
    y: (m,) in m, of the rows.
    middle: (3,) in m, the centre of the rectangle in the frame of the grid.
    axes: (3, 3), axes (3, 3) of the rectangle in the frame of the grid; it is along the first two.
    size: (2,) in m, of the rectangle.
    amount: any unit, to be added.
    near: m; points at most so far below the rectangle count.
    """
    reach = np.hypot(size[0], size[1]) / 2
    left, right = np.searchsorted(x, (middle[0] - reach, middle[0] + reach))
    low, high = np.searchsorted(y, (middle[1] - reach, middle[1] + reach))
    dx, dy = x[left:right] - middle[0], y[low:high, None] - middle[1]
    along, across = axes[0, 0] * dx + axes[1, 0] * dy, axes[0, 1] * dx + axes[1, 1] * dy
    inside = (np.abs(along) <= size[0] / 2) & (np.abs(across) <= size[1] / 2)
    height = middle[2] + axes[2, 0] * along + axes[2, 1] * across
    grid[low:high, left:right] += amount * (inside & (height <= near))
