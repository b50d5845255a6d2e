"""Which things stand on a base or on another thing in a model, as far as their distances tell."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.model.contact_bits import CARRIES, HANDLE, WORKS

STANDS_M = 0.003
"""Things at most this far from a base, or from what stands on it, stand on it."""

HIGHER_M = 0.0002
"""What stands on a thing does not reach as far down as it, by more than this."""


def find_standing(model: Any, data: Any, carrier: int, others: Iterable[int]) -> list[int]:
    """Return which of `others`, root bodies, stand on a carrier or on each other; all by number."""
    left = {body: _geoms(model, body) for body in others if body != carrier}
    lowest, touching, found = _lowest(model, data, _geoms(model, carrier)), _geoms(model, carrier), list[int]()
    left = {body: geoms for body, geoms in left.items() if _lowest(model, data, geoms) > lowest + HIGHER_M}
    while near := [body for body, geoms in left.items() if _is_near(model, data, geoms, touching)]:
        found += near
        touching = [geom for body in near for geom in left.pop(body)]
    return found


def _geoms(model: Any, root: int) -> list[int]:
    """Return the geoms of a body and of all that is attached to it, but for links of arms."""
    kinds, roots = model.geom_contype, model.body_rootid[model.geom_bodyid]
    return [int(g) for g in np.flatnonzero((roots == root) & (kinds & (CARRIES | WORKS | HANDLE) > 0))]


def _lowest(model: Any, data: Any, geoms: list[int]) -> float:
    """Return the height in m of the lowest point of the boxes around geoms."""
    middle, half = model.geom_aabb[geoms, :3], model.geom_aabb[geoms, 3:]
    up = data.geom_xmat[geoms].reshape(-1, 3, 3)[:, 2]
    heights = data.geom_xpos[geoms, 2] + (up * middle).sum(axis=1) - (np.abs(up) * half).sum(axis=1)
    return float(heights.min(initial=np.inf))


def _is_near(model: Any, data: Any, ones: list[int], others: list[int]) -> bool:
    none = np.zeros(6)
    return any(
        mujoco.mj_geomDistance(model, data, one, other, 2 * STANDS_M, none) < STANDS_M
        for one in ones
        for other in others
    )
