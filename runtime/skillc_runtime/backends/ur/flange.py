"""Where the flange of an arm is by its model, in the frames of the model and of the controller."""

from __future__ import annotations

from math import acos, sqrt
from pathlib import Path

import mujoco
import numpy as np

from skillc_runtime.motion.arrays import OutVector, Vector

TURN = np.array([-1.0, -1.0, 1.0])
"""The controller's base is turned by pi about z beside `base_link`: x and y change their signs."""

TINY = 1e-12


class FlangeModel:
    """The kinematics of one arm; q (nv,) in rad in the order of its joints."""

    def __init__(self, model: Path) -> None:
        """Load an MJCF file with a site `flange`."""
        self._model = mujoco.MjModel.from_xml_path(str(model))
        self._data = mujoco.MjData(self._model)
        self._site = self._model.site("flange").id
        self._rotation = self._data.site_xmat[self._site].reshape(3, 3)
        self._position = self._data.site_xpos[self._site]
        self._quaternion, self._told = np.zeros(4), np.zeros((3, 3))

    def find_error(self, told: list[float]) -> tuple[float, float]:
        """Return how far the flange is from the pose (6,) in m and rad that the controller says, in m and rad."""
        away = TURN * self._position - told[:3]
        angle = sqrt(sum(part * part for part in told[3:]))
        mujoco.mju_axisAngle2Quat(self._quaternion, np.array(told[3:]) / max(angle, TINY), angle)
        mujoco.mju_quat2Mat(self._told.ravel(), self._quaternion)
        cosine = (float(TURN @ (self._told * self._rotation).sum(axis=1)) - 1.0) / 2.0
        return float(np.linalg.norm(away)), acos(min(max(cosine, -1.0), 1.0))

    def move(self, q: Vector) -> None:
        """Put the joints at q (6,) in rad; the other methods are about this posture."""
        self._data.qpos[:] = q
        mujoco.mj_kinematics(self._model, self._data)

    def on_flange(self, wrench: list[float], out: OutVector) -> None:
        """Write a wrench (6,) along the axes of the controller's base to `out` (6,), along those of the flange."""
        in_base = TURN * np.array(wrench).reshape(2, 3)
        np.matmul(in_base, self._rotation, out=out.reshape(2, 3))
