"""Which geoms of a model MuJoCo compares in its search for contacts, wherever they are."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array


def find_pairs(model: Any) -> Array:
    """Return what MuJoCo may find in contact, (n, 6) as `far_bodies.Clearances` has it, margins 0."""
    kinds, met = model.geom_contype, model.geom_conaffinity
    meets = (kinds[:, None] & met) | (met[:, None] & kinds)
    owners, planes = model.geom_bodyid, model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE
    left_out = _find_excluded(model)
    rows = []
    for one, other in np.argwhere(np.triu(meets, 1)).tolist():
        if not left_out[owners[one], owners[other]]:
            first, second = (other, one) if planes[other] else (one, other)
            rows.append((first, second, owners[first], owners[second], 0.0, planes[first]))
    return np.array(rows, dtype=np.float64).reshape(-1, 6)


def _find_excluded(model: Any) -> NDArray[np.bool_]:
    """Return which pairs of bodies (nbody, nbody) MuJoCo leaves out whatever their bits are."""
    roots = model.body_weldid
    above, stands = roots[model.body_parentid[roots]], model.body_dofnum[roots] == 0
    excluded: NDArray[np.bool_] = (roots[:, None] == roots) | (stands[:, None] & stands)
    if not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_FILTERPARENT:
        adjacent = (roots[:, None] == above) & (roots[:, None] != 0) & (roots != 0)
        excluded |= adjacent | adjacent.T
    for signature in model.exclude_signature.tolist():
        one, other = signature >> 16, signature & 0xFFFF
        excluded[one, other] = excluded[other, one] = True
    return excluded
