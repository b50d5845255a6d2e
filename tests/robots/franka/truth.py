"""What is true of the things around the simulated robot, in the world of their scene, for the table of bodies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from robots.franka.things import DESK, FACE, SWITCHES_M
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.motion.pose import Array, Pose

FACE_OUT = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]])
"""The axes of the working face, z out of the tool, in the body that has it."""


class PeersTruth:
    """Records the tool and the button of a scene; `height_m` is that of the robot's base in the world of the scene."""

    def __init__(self, model: Any, data: Any, force_on: Callable[[int], float], height_m: float) -> None:
        self._model, self._data, self._force_on = model, data, force_on
        self._up = np.array([0.0, 0.0, height_m])
        geoms = {model.geom(each).name for each in range(model.ngeom)}
        self._face = model.geom(FACE) if FACE in geoms else None
        self._cap = model.geom("cap") if "cap" in geoms else None
        self._rows: list[Array] = []
        self._pressed: list[tuple[float, float, float]] = []

    def see(self) -> None:
        """Note a step."""
        if self._face is not None:
            force = self._force_on(self._model.geom(DESK).id)
            rotation = self._data.geom_xmat[self._face.id].reshape(3, 3) @ FACE_OUT
            middle = self._data.geom_xpos[self._face.id] + self._up + self._face.size[2] * rotation[:, 2]
            quaternion = np.zeros(4)
            mujoco.mju_mat2Quat(quaternion, rotation.ravel())
            self._rows.append(np.array([self._data.time, force, *middle, *quaternion]))
        if self._cap is not None and (force := self._force_on(self._cap.id)) > 0.0:
            switched = float(self._data.joint("cap").qpos[0] >= SWITCHES_M)
            self._pressed.append((self._data.time, force, switched))

    def recording(self, tool: str) -> Recording:
        """Return what was recorded of the tool; its speed is the change of its position."""
        seen = np.array(self._rows)
        rows = np.full((len(seen), 25), np.nan)
        rows[:, :9], rows[:, 24] = seen, seen[:, 1]
        rows[:, 9:12] = np.gradient(seen[:, 2:5], seen[:, 0], axis=0)
        return Recording(rows)

    def surface_pose(self, surface: str) -> Pose:
        """Return the pose of the top of a box."""
        box = self._model.geom(_name(surface))
        rotation = self._data.geom_xmat[box.id].reshape(3, 3).copy()
        return Pose(self._data.geom_xpos[box.id] + self._up + box.size[2] * rotation[:, 2], rotation)

    def body_pose(self, thing: str) -> Pose:
        """Return the pose of a thing."""
        body = self._data.body(_name(thing))
        return Pose(body.xpos + self._up, body.xmat.reshape(3, 3).copy())

    def pressing(self, button: str) -> Array:
        """Return the steps (n, 3) in which something pressed the button: s, N, whether it has switched."""
        return np.array(self._pressed).reshape(-1, 3)


def _name(individual: str) -> str:
    return individual.rpartition("#")[2]
