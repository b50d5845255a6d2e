"""The bumper of a simulated mobile base: it feels what the base would drive into, which stands or slides there."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.model.contact_bits import CARRIES
from skillc_runtime.motion.pose import Array, Pose, rotation_from_quaternion

DEPTH_M = 0.002
"""How far the bumper gives way; what overlaps more than at the start of a drive counts as touched."""

SEEN_M = 0.5
"""The distance beyond which all obstacles count as equally far away."""


class Bumper:
    """Compares the box of one base with furniture, drawers and fixtures; MuJoCo computes no contacts between the two.

    reach_m: of the box from the axis about which the base turns. free_m: how far the base could go, when it was
    compared last, before it touches anything.

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
        self.reach_m = float(np.linalg.norm(self._in_base.position) + np.linalg.norm(model.geom_size[self._box]))
        self.free_m, self._seen = 0.0, self._find_obstacles()

    def begin(self, pose: Pose) -> None:
        """Allow what overlaps with the base at its pose in the world, at the start of a drive."""
        self._put(pose)
        self._allowed = {each: min(self._distance(each), 0.0) for each in self._obstacles}

    def touched(self, pose: Pose) -> str | None:
        """Return what the base would touch at a pose in the world, by the name of its body; None for nothing."""
        self._put(pose)
        self.free_m, self._seen = SEEN_M, self._find_obstacles()
        for each in self._obstacles:
            free_m = self._distance(each) - self._allowed[each] + DEPTH_M
            if free_m < 0:
                return str(self._model.body(self._model.geom_bodyid[each]).name)
            self.free_m = min(self.free_m, free_m)
        return None

    @property
    def obstacles_stand(self) -> bool:
        """Whether obstacles are where they were when the base was compared last: bases and drawers move as well."""
        return np.array_equal(self._find_obstacles(), self._seen)

    def _find_obstacles(self) -> Array:
        return np.hstack([self._data.geom_xpos[self._obstacles], self._data.geom_xmat[self._obstacles]])

    def _put(self, pose: Pose) -> None:
        """Put the box where it is with the base at a pose in the world."""
        box = pose @ self._in_base
        self._data.geom_xpos[self._box], self._data.geom_xmat[self._box] = box.position, box.rotation.ravel()

    def _distance(self, obstacle: int) -> float:
        return float(mujoco.mj_geomDistance(self._model, self._data, self._box, obstacle, SEEN_M, None))
