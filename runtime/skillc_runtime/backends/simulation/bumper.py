"""The bumper of a simulated mobile base: it feels what the base would drive into, which stands or slides there."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.contact_bits import CARRIES
from skillc_runtime.motion.pose import Pose, rotation_from_quaternion

DEPTH_M = 0.002
"""How far the bumper gives way; what overlaps more than at the start of a drive counts as touched."""


class Bumper:
    """Compares the box of one base with furniture, drawers and fixtures; MuJoCo computes no contacts between the two.

    It writes where the box is in `data`, which the next step of the simulation computes again.
    """

    def __init__(self, body: str, model: Any, data: Any) -> None:
        """Watch the base with a body of that name in the model."""
        self._model, self._data = model, data
        base = int(model.body(body).id)
        owners, kinds, types = model.geom_bodyid, model.geom_contype, model.geom_type
        fixed = (kinds & CARRIES > 0) & (types != mujoco.mjtGeom.mjGEOM_PLANE)
        fixed &= model.body_rootid[owners] != model.body_rootid[base]
        self._obstacles = [int(geom) for geom in np.flatnonzero(fixed)]
        self._box = int(np.flatnonzero(owners == base)[0])
        turn = rotation_from_quaternion(model.geom_quat[self._box])
        self._in_base = Pose(model.geom_pos[self._box].copy(), turn)
        self._allowed = dict.fromkeys(self._obstacles, 0.0)

    def begin(self, pose: Pose) -> None:
        """Allow what overlaps with the base at its pose in the world, at the start of a drive."""
        self._put(pose)
        self._allowed = {each: min(self._distance(each), 0.0) for each in self._obstacles}

    def touched(self, pose: Pose) -> str | None:
        """Return what the base would touch at a pose in the world, by the name of its body; None for nothing."""
        self._put(pose)
        for each in self._obstacles:
            if self._distance(each) < self._allowed[each] - DEPTH_M:
                return str(self._model.body(self._model.geom_bodyid[each]).name)
        return None

    def _put(self, pose: Pose) -> None:
        """Put the box where it is with the base at a pose in the world."""
        box = pose @ self._in_base
        self._data.geom_xpos[self._box], self._data.geom_xmat[self._box] = box.position, box.rotation.ravel()

    def _distance(self, obstacle: int) -> float:
        return float(mujoco.mj_geomDistance(self._model, self._data, self._box, obstacle, DEPTH_M, None))
