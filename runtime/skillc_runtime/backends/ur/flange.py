"""Where the flange of an arm is by its model, in the frames of the model and of the controller."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np

from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.pose import Array

TURN = np.array([-1.0, -1.0, 1.0])
"""The controller's base is turned by pi about z beside `base_link`: x and y change their signs."""


class FlangeModel:
    """The kinematics of one arm; q (nv,) in rad in the order of its joints."""

    def __init__(self, model: Path) -> None:
        """Load an MJCF file with a site `flange`."""
        self._model = mujoco.MjModel.from_xml_path(str(model))
        self._data = mujoco.MjData(self._model)
        self._site = self._model.site("flange").id
        self._rotation = self._data.site_xmat[self._site].reshape(3, 3)
        self._position = self._data.site_xpos[self._site]

    @property
    def joints(self) -> int:
        """The number of joints."""
        return int(self._model.nv)

    def at(self, q: Vector) -> Array:
        """Return the flange's position (3,) in m, in the controller's base."""
        self.move(q)
        found: Array = TURN * self._position
        return found

    def move(self, q: Vector) -> None:
        """Put the joints at q (nv,) in rad, for `on_flange`."""
        self._data.qpos[:] = q
        mujoco.mj_kinematics(self._model, self._data)

    def on_flange(self, wrench: list[float], out: OutVector) -> None:
        """Write a wrench (6,) along the axes of the controller's base to `out` (6,), along those of the flange."""
        in_base = TURN * np.array(wrench).reshape(2, 3)
        np.matmul(in_base, self._rotation, out=out.reshape(2, 3))
