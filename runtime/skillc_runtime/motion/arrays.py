"""Array types that state the number of dimensions, for readers and for `numerics.compiled`."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

Vector = Annotated[NDArray[np.float64], 1, "read"]
Matrix = Annotated[NDArray[np.float64], 2, "read"]
OutVector = Annotated[NDArray[np.float64], 1, "written"]
OutMatrix = Annotated[NDArray[np.float64], 2, "written"]
"""Arguments of compiled functions: arrays that are read, in any layout, or written, in C order."""
