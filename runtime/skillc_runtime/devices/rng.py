"""Random numbers of a simulated run: a generator for each individual, independent of the rest of the scene."""

from __future__ import annotations

from zlib import crc32

import numpy as np


def rng_for(individual: str, seed: int, *purpose: int) -> np.random.Generator:
    """Return the generator for one individual and purpose in the run of a seed; the same numbers in each call."""
    return np.random.default_rng([seed, crc32(individual.encode()), *purpose])
