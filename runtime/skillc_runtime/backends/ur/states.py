"""What the controller of an arm sends in each cycle, as the client library receives it."""

from __future__ import annotations

from collections.abc import Callable
from math import acos, sqrt
from pathlib import Path
from time import monotonic, sleep
from typing import Any, Final

import mujoco
import numpy as np

from skillc_runtime.backends.control_process.link import DeviceCondition, LinkLost, StateView
from skillc_runtime.backends.ur.facts import UrFacts
from skillc_runtime.backends.ur.leaving import in_one_line
from skillc_runtime.backends.ur.library import load_library
from skillc_runtime.devices.backend import BackendUnavailable
from skillc_runtime.motion.arrays import OutVector, Vector

RUNNING: Final = 7
"""The `robot_mode` of an arm with power and without brakes."""

PLAYING: Final = 2
"""The `runtime_state` of a controller that executes a program."""

PROTECTIVE_STOP, SAFEGUARD_STOP, EMERGENCY_STOP, VIOLATION, FAULT = 2, 4, 7, 8, 9
"""Bits of `safety_status_bits` (guide to the Real-Time Data Exchange)."""

ROBOT_MODES: Final = {
    -1: "has no controller", 0: "is disconnected", 1: "waits for the confirmation of its safety settings",
    2: "is booting", 3: "has no power", 4: "is being switched on", 5: "has its brakes on", 6: "is in backdrive",
    8: "is updating its firmware",
}  # fmt: skip
"""The other robot modes."""

READY: Final = DeviceCondition("ready")
IN_CONTROL: Final = DeviceCondition("in-control")

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


VARIABLES = [
    "timestamp", "target_q", "actual_q", "actual_qd", "actual_TCP_pose", "actual_TCP_force", "robot_mode",
    "runtime_state", "safety_status_bits", "speed_scaling", "target_speed_fraction",
]  # fmt: skip

WAIT_SHARE, LOOK_S, SLOW_LOOK_S = 0.6, 1e-4, 2e-3
"""After a share of a period it is looked whether a new state is there, each so many s; slowly where there is time."""

REACH_M = 2.0
"""No flange is farther from an axis of its arm."""


class UrStates:
    """The connection that only reads."""

    def __init__(self, facts: UrFacts, period_s: float) -> None:
        """Connect; BackendUnavailable, with what to do."""
        self._facts, self._name, self._period_s = facts, facts.name, period_s
        self._flange = FlangeModel(facts.model)
        self._stamp = -1.0
        self._next_s = self._away_m = self._turn = 0.0
        try:
            self.connection: Any = load_library("rtde_receive").RTDEReceiveInterface(
                facts.address, 1.0 / period_s, VARIABLES
            )
        except RuntimeError as error:
            raise BackendUnavailable(
                f"{self._name} does not offer its Real-Time Data Exchange (port 30004): {in_one_line(error)}"
            ) from error

    @property
    def is_connected(self) -> bool:
        """Whether the connection is there, as far as the library has noticed."""
        return bool(self.connection.isConnected())

    @property
    def executes(self) -> bool:
        """Whether the controller executes a program."""
        return bool(self.connection.getRuntimeState() == PLAYING)

    @property
    def can_move(self) -> bool:
        """Whether the arm has power, and no protective stop."""
        return self.connection.getRobotMode() == RUNNING and not self.connection.isProtectiveStopped()

    @property
    def force_n(self) -> float:
        """The force on the tool in N."""
        return float(np.linalg.norm(self.connection.getActualTCPForce()[:3]))

    @property
    def is_like_the_model(self) -> bool:
        """Whether the flange was where the model says when it was read last; meaningful while it is the tool centre.

        Posture and pose may be of two states, one after the other.
        """
        facts, turn = self._facts, float(np.abs(self.connection.getActualQd()).sum()) * self._period_s
        return self._away_m <= facts.tolerance_m + REACH_M * turn and self._turn <= facts.tolerance_rad + turn

    def explain_flange(self) -> str | None:
        """Return how the controller's tool centre point differs from the flange of the model; None if it does not."""
        self._flange.move(np.array(self.connection.getActualQ()))
        self._compare_flange()
        if self.is_like_the_model:
            return None
        away = f"{1e3 * self._away_m:.0f} mm and {np.degrees(self._turn):.0f} deg"
        return (
            f"the flange of {self._name} is {away} away from where its model says, by its own kinematics: is it the "
            "arm that the scene says? (ur:flangeTolerance and ur:flangeAngleTolerance are what may remain)"
        )

    def is_alive(self) -> bool:
        """Tell whether the controller still sends states."""
        before = self.connection.getTimestamp()
        return self.is_connected and self.await_that(
            lambda: self.connection.getTimestamp() != before, self._facts.silence_s
        )

    def await_that(self, holds: Callable[[], bool], seconds: float) -> bool:
        """Wait until something holds, for so long; tell whether it does."""
        until = monotonic() + seconds
        while not (held := holds()) and monotonic() < until:
            sleep(SLOW_LOOK_S)
        return held

    def await_program(self, seconds: float) -> None:
        """Wait until the controller executes a program, or until so many s of its own time have passed."""
        until = self.connection.getTimestamp() + seconds
        self.await_that(lambda: self.executes or self.connection.getTimestamp() > until, 2.0 * seconds)

    def await_next(self) -> None:
        """Wait for the next state; LinkLost if none comes."""
        receive, silence_s = self.connection, self._facts.silence_s
        sleep(max(self._next_s - monotonic(), 0.0))
        until = monotonic() + silence_s
        while (stamp := receive.getTimestamp()) == self._stamp:
            if not receive.isConnected():
                raise LinkLost(f"{self._name} has closed the connection")
            if monotonic() > until:
                raise LinkLost(f"{self._name} has sent no state for {1e3 * silence_s:.0f} ms")
            sleep(LOOK_S)
        self._stamp, self._next_s = stamp, monotonic() + WAIT_SHARE * self._period_s

    def read(self, state: StateView) -> None:
        """Write the present state."""
        receive = self.connection
        state.stamp_s[0] = self._stamp
        state.speed_share[0] = receive.getSpeedScaling() * receive.getTargetSpeedFraction()
        state.q[:], state.dq[:], state.target[:] = receive.getActualQ(), receive.getActualQd(), receive.getTargetQ()
        state.effort[:] = 0.0
        self.read_wrench(state.wrench)
        self._compare_flange()

    def read_wrench(self, out: OutVector) -> None:
        """Write the present wrench (6,) on the flange, N and N m, along its axes."""
        self._flange.move(np.array(self.connection.getActualQ()))
        self._flange.on_flange(self.connection.getActualTCPForce(), out)

    def read_condition(self, controls: bool) -> DeviceCondition:
        """Return the condition; `controls`: whether the program that the controller executes is ours."""
        receive = self.connection
        return read_condition(
            self._name, receive.getSafetyStatusBits(), receive.getRobotMode(), receive.getRuntimeState(),
            controls=controls,
        )  # fmt: skip

    def _compare_flange(self) -> None:
        self._away_m, self._turn = self._flange.find_error(self.connection.getActualTCPPose())


def read_condition(name: str, safety_bits: int, robot_mode: int, runtime: int, *, controls: bool) -> DeviceCondition:
    """Return the condition of a controller; `controls`: whether the program that it executes is ours."""
    stop = _read_stop(name, safety_bits)
    if stop is not None:
        return stop
    if robot_mode != RUNNING:
        what = ROBOT_MODES.get(robot_mode, f"is in robot mode {robot_mode}")
        return DeviceCondition("wrong-mode", f"{name} {what}: switch it on and release its brakes at its panel")
    if controls and runtime == PLAYING:
        return IN_CONTROL
    if controls:
        return DeviceCondition(
            "not-in-control",
            f"the program that moves {name} has ended: somebody has stopped it or switched the panel to local "
            "control, or commands were missing for longer than ur:commandTimeout",
        )
    if runtime == PLAYING:
        return DeviceCondition("not-in-control", f"{name} executes another program: stop that at its panel first")
    return READY


def _read_stop(name: str, bits: int) -> DeviceCondition | None:
    """Return why the safety system has stopped the arm; None if it has not."""
    if bits >> EMERGENCY_STOP & 1:
        return DeviceCondition(
            "emergency-stop",
            f"the emergency stop of {name} is pressed: release it, then switch the arm on at its panel",
        )
    if bits >> VIOLATION & 1 or bits >> FAULT & 1:
        return DeviceCondition(
            "protective-stop", f"the safety system of {name} reports a fault: read it and restart it at the panel"
        )
    if bits >> SAFEGUARD_STOP & 1:
        return DeviceCondition("protective-stop", f"the safeguard stop of {name} is active: somebody is in its cell")
    if bits >> PROTECTIVE_STOP & 1:
        return DeviceCondition(
            "protective-stop",
            f"{name} has stopped by itself (protective stop): a limit of its safety system, or a collision; its panel "
            "says which",
        )
    return None
