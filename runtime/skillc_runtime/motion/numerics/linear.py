"""Linear algebra of small matrices, and cells under a tool: compiled loops, or calls of libraries without numba.

Both agree up to rounding. Results are written to the last argument.
"""

from __future__ import annotations

from skillc_runtime.motion.numerics.compiled import COMPILES

if COMPILES:
    from skillc_runtime.motion.numerics.loops import (
        add_under,
        cholesky,
        cholesky_solve,
        copy_matrix,
        copy_vector,
        cross,
        product,
        rotation_between,
        rotation_by,
        rotation_of,
        squared,
        times,
        transposed_times,
    )
else:
    from skillc_runtime.motion.numerics.libraries import (
        add_under,
        cholesky,
        cholesky_solve,
        copy_matrix,
        copy_vector,
        cross,
        product,
        rotation_between,
        rotation_by,
        rotation_of,
        squared,
        times,
        transposed_times,
    )

__all__ = [
    "add_under",
    "cholesky",
    "cholesky_solve",
    "copy_matrix",
    "copy_vector",
    "cross",
    "product",
    "rotation_between",
    "rotation_by",
    "rotation_of",
    "squared",
    "times",
    "transposed_times",
]
