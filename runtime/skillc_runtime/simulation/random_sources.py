"""Where chance comes from in a simulated run: a source for each thing, whatever else there is."""

from __future__ import annotations

from zlib import crc32

import numpy as np


def rng_for(individual: str, seed: int, *purpose: int) -> np.random.Generator:
    """Return a source of chance for one thing in one run, the same whenever it is asked for."""
    return np.random.default_rng([seed, crc32(individual.encode()), *purpose])
