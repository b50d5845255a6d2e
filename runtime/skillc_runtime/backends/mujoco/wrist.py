"""The force/torque sensor at a wrist: low-passed, without weight and inertia of the hand, at the tool centre point."""

from __future__ import annotations

import math
from typing import Any

import msgspec
import mujoco
import numpy as np

from skillc_runtime.backends.simulation.names import part_name, wrist_sensor_name
from skillc_runtime.backends.simulation.noise import Noise, make_no_noise
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.devices.reality import NO_SIZES, Sizes
from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled, inlined
from skillc_runtime.motion.pose import Array, Pose, skew

MEAN_S = 0.3
"""Time constant of the mean by which a sensor is tared: its noise counts as that of the mean of 0.6 s."""


class WristFilter(msgspec.Struct, frozen=True):
    """The low-pass filter of a sensor.

    filtered (9,) moves by `share` of the difference to the noisy raw ones (9,) in each step, and mean (9,) by
    `slow_share` of that to the filtered ones; noise (n, 9), of which `used` (1,) rows are used up; started (1,): 0
    before the first sample, which both begin with. readings (9,) are what it measures of them: anew each `period_s`, in
    multiples of grain (9,), if that is not 0; due (1,): s, when it does next.
    """

    readings: OutVector
    filtered: OutVector
    mean: OutVector
    raw: Vector
    noise: Matrix
    used: OutVector
    share: float
    slow_share: float
    started: OutVector
    grain: Vector
    period_s: float
    due: OutVector


@inlined
def _measure(wrist: WristFilter, now: float) -> None:
    """Measure what is filtered, if it is time for that."""
    if now < wrist.due[0]:
        return
    wrist.due[0] = now + wrist.period_s - 1e-9
    for i in range(wrist.filtered.size):
        grain = wrist.grain[i]
        wrist.readings[i] = grain * round(wrist.filtered[i] / grain) if grain > 0.0 else wrist.filtered[i]


@compiled
def filter_wrist(wrist: WristFilter, now: float) -> int:
    """Filter the readings of one step; return 1, and do nothing, if all noise is used up."""
    if wrist.started[0] == 0.0:
        for i in range(wrist.raw.size):
            wrist.filtered[i] = wrist.mean[i] = wrist.raw[i]
        wrist.started[0] = 1.0
        _measure(wrist, now)
        return 0
    row = int(wrist.used[0])
    if row == wrist.noise.shape[0]:
        return 1
    wrist.used[0] += 1.0
    for i in range(wrist.raw.size):
        wrist.filtered[i] += wrist.share * (wrist.raw[i] + wrist.noise[row, i] - wrist.filtered[i])
        wrist.mean[i] += wrist.slow_share * (wrist.filtered[i] - wrist.mean[i])
    _measure(wrist, now)
    return 0


class Wrist(OnMemory):
    """The sensor S between flange and gripper, whose frame is the gripper's root.

    MuJoCo reports what the parent does to the child: a hanging child of 2 kg reads +20 N upwards. An accelerometer
    beside the sensor reads s = a - g. With masses m at c, relative to the sensor: f_ext = m s - f_S,
    t_ext = c x m s - t_S, at the tool centre point p: t_ext - p x f_ext. This removes weight and inertia, except for
    rotational inertia. It is one constant matrix until the next grasp: w = G [f; t; s], along the sensor's axes.

    gain (6, 9): G; readings (9,): [f; t; s], low-passed, zeros before any sample; mean (9,): of these. `step` filters
    one simulation step.
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
        sizes: Sizes = NO_SIZES,
    ) -> None:
        """Find the sensor of a gripper, which writes `gain` and `readings`; `noise` is that of the readings (9,).

        `sizes` are the imperfections of its arm.
        """
        first = model.sensor(wrist_sensor_name(gripper, "force")).adr[0]
        share = 1.0 - math.exp(-model.opt.timestep / time_constant_s) if time_constant_s > 0 else 1.0
        slow_share = 1.0 - math.exp(-model.opt.timestep / MEAN_S)
        self.gain, self.readings, self._noise, self.mean = gain, readings, noise or make_no_noise(9), np.zeros(9)
        raw, rows, used = data.sensordata[first : first + 9], self._noise.rows, self._noise.used
        grain, period_s = np.zeros(9), float(sizes.get("forceTorquePeriod", (0.0,))[0])
        grain[:3], grain[3:6] = sizes.get("forceResolution", 0.0), sizes.get("torqueResolution", 0.0)
        memory = WristFilter(
            readings, np.zeros(9), self.mean, raw, rows, used, share, slow_share, np.zeros(1), grain, period_s,
            np.zeros(1),
        )  # fmt: skip
        super().__init__(bind(filter_wrist, memory))
        self._coupling = make_coupling(sizes)
        self._hand_mass, self._hand_centre = _hand(model, part_name(gripper, "palm"))

    def configure(self, tool: Pose, payload_kg: float, payload_centre: Array) -> None:
        """Set the tool centre point and a payload with its centre of mass (3,) in m, both in the sensor's frame."""
        mass = self._hand_mass + payload_kg
        moment = skew(self._hand_mass * self._hand_centre + payload_kg * payload_centre)
        at_sensor = np.hstack([-self._coupling, np.vstack([mass * np.eye(3), moment])])
        to_tool = np.eye(6)
        to_tool[3:, :3] = -skew(tool.position)
        self.gain[:] = to_tool @ at_sensor

    def act(self, events: int, now: float) -> bool:
        """Draw noise for the next steps, and filter this one."""
        self._noise.draw()
        self.step(now)
        return False


def make_coupling(sizes: Sizes) -> Array:
    """Return the matrix (6, 6) by which the sensor's force N and torque N m follow from the true ones.

    Each has an error of its gain; a force has shares of the other forces, a torque of the other torques.
    """
    coupling = np.eye(6) + np.diag(np.broadcast_to(sizes.get("forceGainError", 0.0), 6))
    cross = np.broadcast_to(sizes.get("forceCrossTalk", 0.0), 12)
    for half, numbers in ((slice(0, 3), cross[:6]), (slice(3, 6), cross[6:])):
        coupling[half, half][~np.eye(3, dtype=bool)] += numbers
    return coupling


def _hand(model: Any, palm: str) -> tuple[float, Array]:
    """Return the mass in kg of a gripper and its centre of mass (3,) m in its root's frame, fingers at their zero."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    body = model.body(palm).id
    centre = data.xmat[body].reshape(3, 3).T @ (data.subtree_com[body] - data.xpos[body])
    return float(model.body_subtreemass[body]), centre
