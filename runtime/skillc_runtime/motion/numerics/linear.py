"""The linear algebra of small matrices, and cells under a tool: loops if compiled, else calls of libraries.

The two agree but for rounding. Results are written to the last argument.
"""

from __future__ import annotations

from skillc_runtime.motion.numerics.compiled import COMPILES

if COMPILES:
    from skillc_runtime.motion.numerics.loops import (
        add_under,
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
    from skillc_runtime.motion.numerics.libraries import (
        add_under,
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
    "add_under",
    "cholesky",
    "cholesky_solve",
    "cross",
    "product",
    "rotation_between",
    "rotation_by",
    "times",
    "transposed_times",
]
