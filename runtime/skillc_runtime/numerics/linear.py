"""The linear algebra of small matrices: loops where they are compiled, calls of libraries in plain Python.

The two agree but for rounding. Results are written to the last argument.
"""

from __future__ import annotations

from skillc_runtime.numerics.compiled import COMPILES

if COMPILES:
    from skillc_runtime.numerics.loops import (
        cholesky,
        cholesky_solve,
        cross,
        product,
        rotation_between,
        rotation_by,
        times,
        transposed_times,
    )
else:
    from skillc_runtime.numerics.libraries import (
        cholesky,
        cholesky_solve,
        cross,
        product,
        rotation_between,
        rotation_by,
        times,
        transposed_times,
    )

__all__ = [
    "cholesky",
    "cholesky_solve",
    "cross",
    "product",
    "rotation_between",
    "rotation_by",
    "times",
    "transposed_times",
]
