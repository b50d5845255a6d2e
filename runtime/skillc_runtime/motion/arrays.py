"""Arrays: numpy as `np`, or its part for scenes where it is not installed; and types that state dimensions.

What plans and checks need imports `np` from here. The types are for readers and for `numerics.compiled`.
"""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, Annotated

HAS_NUMPY = find_spec("numpy") is not None
if TYPE_CHECKING or HAS_NUMPY:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    IntegerArray = NDArray[np.int64]
else:
    from skillc_runtime.motion import small_arrays as np

    Array = IntegerArray = np.ndarray

__all__ = ["HAS_NUMPY", "Array", "Integers", "Matrix", "OutMatrix", "OutVector", "Vector", "np"]

Vector = Annotated[Array, 1, "read"]
Matrix = Annotated[Array, 2, "read"]
OutVector = Annotated[Array, 1, "written"]
OutMatrix = Annotated[Array, 2, "written"]
Integers = Annotated[IntegerArray, 2, "integers"]
"""Arguments of compiled functions: arrays that are read, in any layout, or written, in C order; integers (n, m) of 64
bits, such as addresses, only in the memory of functions on memory."""
