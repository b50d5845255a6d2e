"""The force/torque sensor at a wrist: low-passed, without weight and inertia of the hand, at the tool centre point."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.names import part_name, wrist_sensor_name
from skillc_runtime.backends.simulation.noise import Noise
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.pose import Array, Pose, skew


class Wrist:
    """The sensor S between flange and gripper, whose frame is the gripper's root.

    MuJoCo reports what the parent does to the child: a hanging child of 2 kg reads +20 N upwards. An accelerometer
    beside the sensor reads s = a - g. With masses m at c, relative to the sensor: f_ext = m s - f_S,
    t_ext = c x m s - t_S, at the tool centre point p: t_ext - p x f_ext. This removes weight and inertia, except for
    rotational inertia. It is one constant matrix until the next grasp: w = G [f; t; s], along the sensor's axes.

    gain (6, 9): G; readings (9,): [f; t; s], low-passed, zeros before any sample.
    """

    def __init__(
        self,
        model: Any,
        data: Any,
        gripper: str,
        time_constant_s: float,
        gain: OutMatrix,
        readings: OutVector,
        noise: Noise | None = None,
    ) -> None:
        """Find the sensor of a gripper, which writes `gain` and `readings`; `noise` is that of the readings (9,)."""
        first = model.sensor(wrist_sensor_name(gripper, "force")).adr[0]
        self._raw = data.sensordata[first : first + 9]
        self._share = 1.0 - math.exp(-model.opt.timestep / time_constant_s) if time_constant_s > 0 else 1.0
        self.gain, self.readings, self._started = gain, readings, False
        self._noise = noise
        self._hand_mass, self._hand_centre = _hand(model, part_name(gripper, "palm"))
        self._quiet = np.zeros(9)

    def configure(self, tool: Pose, payload_kg: float, payload_centre: Array) -> None:
        """Set the tool centre point and a payload with its centre of mass (3,) in m, both in the sensor's frame."""
        mass = self._hand_mass + payload_kg
        moment = skew(self._hand_mass * self._hand_centre + payload_kg * payload_centre)
        at_sensor = np.hstack([-np.eye(6), np.vstack([mass * np.eye(3), moment])])
        to_tool = np.eye(6)
        to_tool[3:, :3] = -skew(tool.position)
        self.gain[:] = to_tool @ at_sensor

    def sample(self) -> None:
        """Filter the reading of one simulation step; the first one initialises the filter."""
        if self._started:
            noise = self._quiet if self._noise is None else self._noise.row()
            low_pass(self.readings, self._raw, noise, self._share)
        else:
            self.readings[:], self._started = self._raw, True


@compiled
def low_pass(readings: OutVector, raw: Vector, noise: Vector, share: float) -> None:
    """Move the readings (9,) by a share of the difference to the noisy raw ones (9,)."""
    readings += share * (raw + noise - readings)


def _hand(model: Any, palm: str) -> tuple[float, Array]:
    """Return the mass in kg of a gripper and its centre of mass (3,) m in its root's frame, fingers at their zero."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    body = model.body(palm).id
    centre = data.xmat[body].reshape(3, 3).T @ (data.subtree_com[body] - data.xpos[body])
    return float(model.body_subtreemass[body]), centre
