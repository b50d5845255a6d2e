"""The parts of fixtures that yield, such as the cap of a button: they have no inertia, only springs and dampers."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Array


class YieldingParts:
    """The joints of all fixtures. slides (j,): 1 if it slides; moves (j, geoms): 1 if the joint moves a geom."""

    def __init__(self, scene: SceneSpec, model: Any, data: Any) -> None:
        prefixes = tuple(part_name(scene.names[each.individual], "") for each in scene.fixtures)
        joints = [j for j in range(model.njnt) if prefixes and model.joint(j).name.startswith(prefixes)]
        dofs, places = model.jnt_dofadr[joints], model.jnt_qposadr[joints]
        self.count, self._joints, self._dofs, self._places, self._data = len(joints), joints, dofs, places, data
        self.slides = (model.jnt_type[joints] == mujoco.mjtJoint.mjJNT_SLIDE).astype(np.float64)
        self.moves = np.array([_moved(model, int(model.jnt_bodyid[j])) for j in joints]).reshape(-1, model.ngeom)
        self._stiffness, self._damping = model.jnt_stiffness[joints].reshape(-1), model.dof_damping[dofs]
        self._rest = model.qpos_spring[places]
        limited = model.jnt_limited[joints].astype(bool)
        self._least = np.where(limited, model.jnt_range[joints, 0], -np.inf)
        self._most = np.where(limited, model.jnt_range[joints, 1], np.inf)

    @property
    def axes(self) -> Array:
        """The axes (j, 3) of the joints in the world."""
        axes: Array = self._data.xaxis[self._joints]
        return axes

    @property
    def anchors(self) -> Array:
        """The anchors (j, 3) in m of the joints in the world."""
        anchors: Array = self._data.xanchor[self._joints]
        return anchors

    def step(self, pressed: Array, period_s: float) -> None:
        """Move for one step: (d / T + k + k_c) dq = f - k (q - q_0).

        pressed (j, 2): f, N or N m, and the stiffness k_c of the contacts, with which a part comes to its balance.
        """
        q, force, contact = self._data.qpos[self._places], pressed[:, 0], pressed[:, 1]
        resisting = self._damping / period_s + self._stiffness + contact
        change = (force - self._stiffness * (q - self._rest)) / np.where(resisting > 0.0, resisting, np.inf)
        after = np.clip(q + change, self._least, self._most)
        self._data.qpos[self._places], self._data.qvel[self._dofs] = after, (after - q) / period_s


def _moved(model: Any, body: int) -> Array:
    """Return 1 for each geom (geoms,) on a body or on its descendants, else 0."""

    def is_moved(at: int) -> bool:
        while at not in (0, body):
            at = int(model.body_parentid[at])
        return at == body

    return np.array([float(is_moved(int(each))) for each in model.geom_bodyid])
