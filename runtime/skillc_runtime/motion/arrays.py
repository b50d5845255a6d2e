"""Types of arrays that say how many dimensions they have, for people and for the compiler of `compiled`."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

Vector = Annotated[NDArray[np.float64], 1, "read"]
Matrix = Annotated[NDArray[np.float64], 2, "read"]
OutVector = Annotated[NDArray[np.float64], 1, "written"]
OutMatrix = Annotated[NDArray[np.float64], 2, "written"]
"""What a compiled function takes: arrays of so many dimensions that it reads, of any layout, or writes, in C order."""
