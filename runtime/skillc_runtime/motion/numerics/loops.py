"""Linear algebra of small matrices as loops, to be compiled; the same functions as in `libraries`."""

from __future__ import annotations

from math import atan2, hypot, sin, sqrt

from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.pose import Array


@inlined
def times(A: Array, x: Array, out: Array) -> None:
    """out = A x.

    A: (m, n), any unit.
    x: (n,), any unit.
    out: (m,), any unit; it is written.
    """
    for i in range(A.shape[0]):
        total = 0.0
        for j in range(A.shape[1]):
            total += A[i, j] * x[j]
        out[i] = total


@inlined
def transposed_times(A: Array, x: Array, out: Array) -> None:
    """out = A^T x.

    A: (m, n), any unit.
    x: (m,), any unit.
    out: (n,), any unit; it is written.
    """
    for j in range(A.shape[1]):
        total = 0.0
        for i in range(A.shape[0]):
            total += A[i, j] * x[i]
        out[j] = total


@inlined
def product(A: Array, B: Array, out: Array) -> None:
    """out = A B.

    A: (m, k), any unit.
    B: (k, n), any unit.
    out: (m, n), any unit; it is written.
    """
    for i in range(A.shape[0]):
        for j in range(B.shape[1]):
            total = 0.0
            for k in range(A.shape[1]):
                total += A[i, k] * B[k, j]
            out[i, j] = total


@inlined
def copy_matrix(A: Array, out: Array) -> None:
    """out (m, n) = A (m, n), in any unit."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            out[i, j] = A[i, j]


@inlined
def copy_vector(x: Array, out: Array) -> None:
    """out (n,) = x (n,), in any unit."""
    for i in range(x.size):
        out[i] = x[i]


@inlined
def squared(x: Array) -> float:
    """Return the sum of the squares of x (n,), in any unit: not finite if one of them is not."""
    total = 0.0
    for i in range(x.size):
        total += x[i] * x[i]
    return total


@inlined
def cross(a: Array, b: Array, out: Array) -> None:
    """out = a x b, along the same axes.

    a: (3,), any unit.
    b: (3,), any unit.
    out: (3,), any unit; it is written.
    """
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]


@inlined
def cholesky(A: Array) -> None:
    """Replace A (n, n), positive definite and in any unit, by its lower factor L, A = L L^T; the part above is kept."""
    for j in range(A.shape[0]):
        left = A[j, j]
        for k in range(j):
            left -= A[j, k] * A[j, k]
        A[j, j] = sqrt(max(left, 0.0))
        for i in range(j + 1, A.shape[0]):
            left = A[i, j]
            for k in range(j):
                left -= A[i, k] * A[j, k]
            A[i, j] = left / A[j, j]


@inlined
def cholesky_solve(L: Array, b: Array, out: Array) -> None:
    """Solve L L^T out = b.

    L: (n, n), any unit.
    b: (n,), any unit.
    out: (n,), any unit; it is written.
    """
    n = L.shape[0]
    for i in range(n):
        left = b[i]
        for k in range(i):
            left -= L[i, k] * out[k]
        out[i] = left / L[i, i]
    for i in range(n - 1, -1, -1):
        left = out[i]
        for k in range(i + 1, n):
            left -= L[k, i] * out[k]
        out[i] = left / L[i, i]


@inlined
def rotation_by(vector: Array, out: Array) -> None:
    """out (3, 3) = the rotation about a vector (3,) in rad of the same frame. Rodrigues' formula; see `motion.pose`."""
    x, y, z = vector[0], vector[1], vector[2]
    angle = sqrt(x * x + y * y + z * z)
    s, c = 1.0, 0.0
    if angle >= 1e-12:
        s, c = sin(angle) / angle, 2 * (sin(angle / 2) / angle) ** 2
    out[0, 0], out[0, 1], out[0, 2] = 1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y
    out[1, 0], out[1, 1], out[1, 2] = c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x
    out[2, 0], out[2, 1], out[2, 2] = c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y)


@inlined
def rotation_of(quaternion: Array, out: Array) -> None:
    """out (3, 3) = the rotation of a quaternion (4,), (w, x, y, z), no unit, in the same frame."""
    w, x, y, z = quaternion[0], quaternion[1], quaternion[2], quaternion[3]
    s = 2 / (w * w + x * x + y * y + z * z)
    out[0, 0], out[0, 1], out[0, 2] = 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)
    out[1, 0], out[1, 1], out[1, 2] = s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)
    out[2, 0], out[2, 1], out[2, 2] = s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)


@inlined
def rotation_between(start: Array, end: Array, out: Array) -> None:
    """out = log(end start^T), along the axes of the parent frame of both rotations. See `motion.pose`.

    Shepperd's quaternion, its signs such that w >= 0.
    start: (3, 3), a rotation (3, 3).
    end: (3, 3), a rotation (3, 3).
    out: (3,) in rad; it is written.
    """
    a, b, c = _row(end, start, 0)
    d, e, f = _row(end, start, 1)
    g, h, i = _row(end, start, 2)
    ww, xx, yy, zz = 1 + a + e + i, 1 + a - e - i, 1 - a + e - i, 1 - a - e + i
    most = max(ww, xx, yy, zz)
    if most == ww:
        w, x, y, z = ww, h - f, c - g, d - b
    elif most == xx:
        w, x, y, z = h - f, xx, b + d, c + g
    elif most == yy:
        w, x, y, z = c - g, b + d, yy, f + h
    else:
        w, x, y, z = d - b, c + g, f + h, zz
    sine = sqrt(x * x + y * y + z * z)
    scale = 2 * atan2(sine, abs(w)) / sine if sine > 0.0 else 0.0
    if w < 0.0:
        scale = -scale
    out[0], out[1], out[2] = scale * x, scale * y, scale * z


@inlined
def _row(end: Array, start: Array, i: int) -> tuple[float, float, float]:
    """Return a row of end start^T."""
    return (
        end[i, 0] * start[0, 0] + end[i, 1] * start[0, 1] + end[i, 2] * start[0, 2],
        end[i, 0] * start[1, 0] + end[i, 1] * start[1, 1] + end[i, 2] * start[1, 2],
        end[i, 0] * start[2, 0] + end[i, 1] * start[2, 1] + end[i, 2] * start[2, 2],
    )


@inlined
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
    reach = hypot(size[0], size[1]) / 2
    for row in range(y.size):
        dy = y[row] - middle[1]
        if abs(dy) > reach:
            continue
        for column in range(x.size):
            dx = x[column] - middle[0]
            along, across = axes[0, 0] * dx + axes[1, 0] * dy, axes[0, 1] * dx + axes[1, 1] * dy
            height = middle[2] + axes[2, 0] * along + axes[2, 1] * across
            inside = abs(dx) <= reach and abs(along) <= size[0] / 2 and abs(across) <= size[1] / 2
            if inside and height <= near:
                grid[row, column] += amount
