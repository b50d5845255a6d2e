"""The result of an inspection: which cells of a surface are dirty, which are clean, and which were not seen."""

from __future__ import annotations

from typing import Final

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, UNSEEN, DirtMap
from skillc_runtime.motion.pose import Array
from skillc_runtime.vision.dirt import Dirt
from skillc_runtime.vision.locate import LocatedSurface

CELL_M: Final = 0.01
"""The edge of a cell, at most."""

SPOTS: Final = 4
"""Spots of a cell along each edge."""

DIRTY_AMOUNT: Final = 0.2
"""The mean amount of dirt of a cell from which on it is dirty."""

LEAST_SEEN: Final = 0.9
"""Which share of a cell must be seen for it to be clean."""

SHADED, GLARING = 0.8, 1.2
"""Light of a spot, relative to the smooth light, below or above which it is not called clean."""

STRANGE = 0.06
"""Colours this far from any mix of clean and dirty are those of something else, which counts as dirt."""


class CellMap(msgspec.Struct, frozen=True):
    """Cells of a surface: rows along y, columns along x, from the least of each, in the frame of the surface.

    state (rows, columns): UNSEEN, CLEAN or DIRTY; what was hidden, shaded or glaring is UNSEEN, never CLEAN. amount
    (rows, columns): of dirt, from 0 to 1, nan where nothing was seen. confidence (rows, columns): the probability that
    the state is right, from the errors of colours and light; 0 where UNSEEN. x (columns,), y (rows,): centres in m.
    """

    state: NDArray[np.uint8]
    amount: Array
    confidence: Array
    x: Array
    y: Array
    located: LocatedSurface

    @property
    def clean_share(self) -> float:
        """The share of all cells that were seen to be clean."""
        return float((self.state == CLEAN).mean())

    @property
    def dirty_share(self) -> float:
        """The share of all cells that were seen to be dirty."""
        return float((self.state == DIRTY).mean())

    @property
    def seen_share(self) -> float:
        """The share of the cells that were seen."""
        return float((self.state != UNSEEN).mean())

    @property
    def dirt_map(self) -> DirtMap:
        """The states and how sure they are, without the rest."""
        rows, columns = self.state.shape
        tenths = np.clip(np.floor(10 * self.confidence), 0, 9).astype(np.uint8)
        return DirtMap(columns, rows, self.state.tobytes(), tenths.tobytes())


def count_cells(size: Array) -> tuple[int, int]:
    """Return how many cells a surface of size (2,) in m has along x and along y."""
    columns, rows = (max(1, round(float(each) / CELL_M)) for each in size)
    return columns, rows


def judge_cells(
    dirt: Dirt, usable: NDArray[np.bool_], centres: tuple[Array, Array], located: LocatedSurface
) -> CellMap:
    """Return the map of cells, of SPOTS x SPOTS spots each; centres x (columns,) and y (rows,) of the cells in m."""
    amount = np.where(
        dirt.strange > STRANGE, np.maximum(dirt.amount, dirt.strange / STRANGE * DIRTY_AMOUNT), dirt.amount
    )
    even = (dirt.brightness > SHADED) & (dirt.brightness < GLARING)
    seen, clear = _means(usable.astype(float)), _means((usable & even).astype(float))
    # Dirt of a cell as a whole: what is not seen of it has none.
    mean = _means(np.where(usable, amount, 0.0)) / np.maximum(seen, 1e-9)
    deviation = _means(np.where(usable, dirt.deviation, 0.0)) / np.maximum(seen, 1e-9)
    dirty = (seen > 0) & (mean * seen >= DIRTY_AMOUNT)
    clean = (clear >= LEAST_SEEN) & (mean < DIRTY_AMOUNT)
    state = np.where(dirty, DIRTY, np.where(clean, CLEAN, UNSEEN)).astype(np.uint8)
    sure = standard_normal(np.abs(mean - DIRTY_AMOUNT) / np.maximum(deviation, 1e-6))
    shown = np.where(seen > 0, np.clip(mean, 0.0, 1.0), np.nan)
    return CellMap(state, shown, np.where(state == UNSEEN, 0.0, sure), *centres, located)


def _means(values: Array) -> Array:
    rows, columns = values.shape
    return np.asarray(values.reshape(rows // SPOTS, SPOTS, columns // SPOTS, SPOTS).mean(axis=(1, 3)))


def standard_normal(deviations: Array) -> Array:
    """Return the standard normal distribution function at values >= 0.

    Abramowitz & Stegun, Handbook of Mathematical Functions, 26.2.17; error below 1e-7.
    """
    t = 1.0 / (1.0 + 0.2316419 * deviations)
    series = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))))
    return np.asarray(1.0 - np.exp(-(deviations**2) / 2) / np.sqrt(2 * np.pi) * series)
