"""The light of a rendered image, drawn from a seed: a lamp, light from afar with shadows, light from everywhere."""

from __future__ import annotations

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array


class DrawnLight(msgspec.Struct, frozen=True):
    """Light: brightness from 0 to 1 of what comes from everywhere, from afar and from a lamp; their sum is about 1.

    direction (3,): in which the far light shines, in the world; lamp (3,): where the lamp is, in m from the middle of
    what is looked at. shine: how much surfaces mirror lights, from 0 to 1. colour (3,): of all light.
    """

    ambient: float
    far: float
    near: float
    direction: Array
    lamp: Array
    shine: float
    colour: Array

    def dimmed(self, by: float) -> DrawnLight:
        """Return the same light, so many times as dark."""
        return replace(self, ambient=self.ambient / by, far=self.far / by, near=self.near / by)


def draw_light(individual: str, seed: int) -> DrawnLight:
    """Return the light of a run."""
    rng = rng_for(individual, seed, 2)
    ambient, far = rng.uniform(0.4, 0.6), rng.uniform(0.05, 0.2)
    around, down = rng.uniform(0.0, 2 * np.pi), rng.uniform(0.3, 0.9)
    direction = np.array([down * np.cos(around), down * np.sin(around), -1.0])
    lamp = np.array([*rng.uniform(-0.8, 0.8, 2), rng.uniform(0.8, 1.6)])
    warm = rng.uniform(-0.15, 0.15)
    colour = np.array([1.0 + warm, 1.0, 1.0 - 1.5 * warm])
    near = 0.95 - ambient - far
    return DrawnLight(
        ambient, far, near, direction / np.linalg.norm(direction), lamp, rng.uniform(0.0, 0.5), colour / colour.max()
    )
