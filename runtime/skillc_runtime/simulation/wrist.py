"""The force/torque sensor at a wrist: low-passed, tool weight removed, moved to the tool centre point."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.simulation.names import part, wrist_sensor


class Wrist:
    """The sensor between flange and gripper.

    MuJoCo reports what the parent does to the child: a hanging child of 2 kg reads +20 N upwards. An accelerometer
    beside the sensor reads s = a - g. With masses m at c, relative to the sensor S: f_ext = m s - f_S,
    t_ext = c x m s - t_S, at the tool centre point p: t_ext - p x f_ext. So weight and inertia are removed at once,
    but for the inertia of turning.
    """

    def __init__(self, model: Any, data: Any, gripper: str, time_constant_s: float) -> None:
        first = model.sensor(wrist_sensor(gripper, "force")).adr[0]
        self._raw = data.sensordata[first : first + 9]
        site, body = model.site(part(gripper, "wrist")).id, model.body(part(gripper, "palm")).id
        self._origin, self._axes = data.site_xpos[site], data.site_xmat[site].reshape(3, 3)
        self._centre = data.subtree_com[body]
        self._mass = float(model.body_subtreemass[body])
        self._share = 1.0 - math.exp(-model.opt.timestep / time_constant_s) if time_constant_s > 0 else 1.0
        self._filtered, self._started = np.zeros(9), False
        self._external, self._moment = np.zeros(6), np.zeros(3)

    def sample(self) -> None:
        """Take in the reading of one simulation step; the first one fills the filter."""
        if self._started:
            self._filtered += self._share * (self._raw - self._filtered)
        else:
            self._filtered[:], self._started = self._raw, True

    def external(self, point: Array, turn: Array, payload: tuple[float, Array]) -> Array:
        """Return what the environment does to the tool, (6,) N, N m, at `point` of the world, in axes `turn` @ world.

        Weight and inertia of gripper and payload (mass kg, centre of mass in the world) are removed; zeros before any
        sample.
        """
        if not self._started:
            return np.zeros(6)
        force, torque = self._external[:3], self._external[3:]
        np.negative(self._axes @ self._filtered[:3], out=force)
        np.negative(self._axes @ self._filtered[3:6], out=torque)
        felt = self._axes @ self._filtered[6:]
        for mass, centre in ((self._mass, self._centre), payload):
            borne = mass * felt
            force += borne
            mujoco.mju_cross(self._moment, centre - self._origin, borne)
            torque += self._moment
        mujoco.mju_cross(self._moment, point - self._origin, force)
        torque -= self._moment
        result = np.empty(6)
        result[:3], result[3:] = turn @ force, turn @ torque
        return result
