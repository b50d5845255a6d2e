"""How reality differs from what the world model believes: drawn once from the ranges in the facts and a seed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from zlib import crc32

import numpy as np

from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.simulation.facts import SurfaceFacts


@dataclass(frozen=True, slots=True)
class SurfaceVariation:
    """One surface: m along its believed normal, rad about its believed x and y, sliding friction."""

    surface: str
    offset_m: float
    tilt_rad: tuple[float, float]
    friction: float

    def true_pose(self, believed: Pose) -> Pose:
        """Return where the surface really is."""
        tilt = exp(np.array([*self.tilt_rad, 0.0]))
        return believed @ Pose(np.array([0.0, 0.0, self.offset_m]), tilt)


@dataclass(frozen=True, slots=True)
class Variation:
    """All differences of one simulated run."""

    seed: int
    surfaces: tuple[SurfaceVariation, ...]

    def of(self, surface: str) -> SurfaceVariation:
        """Return the difference of one surface; KeyError when it has none."""
        for one in self.surfaces:
            if one.surface == surface:
                return one
        raise KeyError(surface)


def draw(surfaces: Sequence[SurfaceFacts], seed: int) -> Variation:
    """Draw the differences, uniform within each surface's ranges; a surface's draw does not depend on the others."""
    return Variation(seed, tuple(_draw(surface, seed) for surface in surfaces))


def _draw(surface: SurfaceFacts, seed: int) -> SurfaceVariation:
    chance = np.random.default_rng([seed, crc32(surface.individual.encode())])
    offset, tilt_x, tilt_y = chance.uniform(-1.0, 1.0, 3)
    return SurfaceVariation(
        surface=surface.individual,
        offset_m=float(offset) * surface.offset_range_m,
        tilt_rad=(float(tilt_x) * surface.tilt_range_rad, float(tilt_y) * surface.tilt_range_rad),
        friction=float(chance.uniform(*surface.friction)),
    )
