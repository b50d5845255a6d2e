"""Where the flange of an arm is, by its model."""

from __future__ import annotations

from typing import Any

from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.pose import Array, Pose


class FlangeModel:
    """The kinematics of one arm, from the file of its model, which is loaded when it is first needed."""

    def __init__(self, model: str) -> None:
        self._file = model
        self._loaded: tuple[Any, Any, int] | None = None

    def turn(self, wrench: OutVector, q: Array) -> None:
        """Turn a wrench (6,) from the axes of the base to those of the flange, with the joints at q (nv,) in rad."""
        rotation = self.find(q).rotation
        wrench[:3], wrench[3:] = rotation.T @ wrench[:3], rotation.T @ wrench[3:]

    def find(self, q: Array) -> Pose:
        """Return the flange in the base, with the joints at q (nv,) in rad."""
        import mujoco

        if self._loaded is None:
            model: Any = mujoco.MjModel.from_xml_path(self._file)
            self._loaded = model, mujoco.MjData(model), model.site("flange").id
        model, data, site = self._loaded
        data.qpos[: q.size] = q
        mujoco.mj_kinematics(model, data)
        return Pose(data.site_xpos[site].copy(), data.site_xmat[site].reshape(3, 3).copy())
