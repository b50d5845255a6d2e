"""How surfaces look while tools work on them: dusty, and clean where a tool was pressed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.film.frames import Shades

DUSTY, CLEAN = (171.0, 160.0, 140.0), (246.0, 250.0, 252.0)
"""Red, green and blue, to 255, of a surface before work and after it."""

DUST_GRAIN = 9.0
"""How much the brightness of dust varies."""


def colour_surface(shades: Shades) -> NDArray[np.uint8]:
    """Return the colours (rows, columns, 3) of the cells of a surface of shades (rows, columns)."""
    grain = np.random.default_rng(3).uniform(-DUST_GRAIN, DUST_GRAIN, (*shades.shape, 1))
    share = (shades / 255.0)[:, :, np.newaxis]
    return np.asarray((1 - share) * (np.array(DUSTY) + grain) + share * np.array(CLEAN)).astype(np.uint8)
