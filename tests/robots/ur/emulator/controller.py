"""The controller: power, safety, programs, inputs and outputs, and what it tells its clients in each cycle."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field
from math import inf

import numpy as np

from robots.ur.emulator.fields import Value
from robots.ur.emulator.kinematics import flange_pose, write_pose
from robots.ur.emulator.limits import Limits
from robots.ur.emulator.motion import Hold, Motion, Servo, Speed, Stop
from robots.ur.emulator.plant import STEP_S, Plant
from robots.ur.emulator.states import SAFETY_BITS, RobotMode, Runtime, SafetyMode
from skillc_runtime.motion.pose import Array

UNLOCK_S = 5.0
"""After this time a protective stop can be released (dashboard guide)."""

START_S = 0.1
"""How long it takes from the upload of a program to its first command; nobody has published that."""

STOPPING = 20.0
"""rad/s^2: how a stop brakes each joint."""


class Refused(Exception):
    """The controller does not do what is asked for; the message is its answer."""


@dataclass
class Settings:
    """What differs between controllers: version, and the sensor's offset (6,) at the flange."""

    version: tuple[int, int, int, int] = (5, 23, 0, 100)
    bias: tuple[float, ...] = (2.0, -1.5, 3.0, 0.1, -0.05, 0.08)
    unlock_s: float = UNLOCK_S
    remote: bool = True
    model: str = "UR5"
    button: int = -1


@dataclass
class Io:
    """Inputs and outputs: bits as of the RTDE guide, and voltages or currents of analogue ones."""

    inputs: int = 0
    outputs: int = 0
    analog_inputs: list[float] = field(default_factory=lambda: [0.0, 0.0])
    analog_outputs: list[float] = field(default_factory=lambda: [0.0, 0.0])


class Controller:
    """The controller of one arm; `cycle` lets 2 ms pass."""

    def __init__(self, plant: Plant, settings: Settings) -> None:
        """Stand in the plant's posture, ready."""
        from robots.ur.emulator.program import Program

        self.plant, self.settings, self.model = plant, settings, settings.model
        self.remote, self.robot_mode, self.safety_mode = settings.remote, RobotMode.RUNNING, SafetyMode.NORMAL
        self.runtime, self.program = Runtime.STOPPED, Program(self)
        self.motion, self.limits, self.io = Motion(plant.q), Limits(), Io()
        self.registers: dict[str, Value] = {}
        self.inputs: dict[str, Value] = {}
        self.heard_at: dict[str, float] = {}
        self.slider, self.payload, self.centre, self.tcp = 1.0, 0.0, np.zeros(3), np.zeros(6)
        self.zero, self.cycles, self.why, self.stopped_at = np.zeros(6), 0, "", -1e9
        self.loaded: list[str] = []
        self._starting_at = inf
        self.wrench, self._heard, self._is_client_silent = np.zeros(6), asyncio.Event(), False

    @property
    def now(self) -> float:
        """The time in s since the controller started."""
        return self.cycles * STEP_S

    def cycle(self) -> None:
        """Let a cycle pass: the program, the motion, and the safety system."""
        self._heard.clear()
        self.cycles += 1
        if self.now >= self._starting_at:
            self._starting_at = inf
            self.program.start(self.loaded[-1])
            self.runtime = Runtime.PLAYING
        if self.runtime == Runtime.PLAYING:
            self.program.cycle()
        self.motion.advance(self.plant, self.wrench, self.slider)
        self.plant.pass_cycle()
        self.wrench = self._measure()
        if self.settings.button >= 0:
            pressed = any(each.switched for each in self.plant.buttons)
            self.io.inputs = self.io.inputs & ~(1 << self.settings.button) | pressed << self.settings.button
        found = self.limits.check_motion(self.plant.dq, self.plant.tool_speed, float(np.linalg.norm(self.wrench[:3])))
        if found is not None:
            self.protect(found)

    @property
    def is_commanded(self) -> bool:
        """Whether a client moves the arm, command by command, and has not been silent since it was waited for."""
        moves = self.runtime == Runtime.PLAYING and isinstance(self.motion.job, Servo | Speed)
        return moves and not self._is_client_silent

    async def wait_for_command(self, seconds: float) -> None:
        """Wait until the program hears of its client again; one that stays silent is not waited for once more."""
        try:
            await asyncio.wait_for(self._heard.wait(), seconds)
        except TimeoutError:
            self._is_client_silent = True

    def take(self, fields: dict[str, Value]) -> None:
        """Take the fields of a package of inputs."""
        self.inputs |= fields
        self.heard_at |= dict.fromkeys(fields, self.now)
        if "input_int_register_0" in fields:
            self._heard.set()
            self._is_client_silent = False
        if fields.get("speed_slider_mask"):
            self.slider = min(max(float(fields["speed_slider_fraction"]), 0.0), 1.0)
        for name, first in (("standard", 0), ("configurable", 8), ("tool", 16)):
            mask = int(fields.get(f"{name}_digital_output_mask", 0)) << first
            self.io.outputs = self.io.outputs & ~mask | int(fields.get(f"{name}_digital_output", 0)) << first & mask
        for which in (0, 1):
            if int(fields.get("standard_analog_output_mask", 0)) >> which & 1:
                self.io.analog_outputs[which] = float(fields[f"standard_analog_output_{which}"])

    def load(self, text: str) -> None:
        """Start a program, which ends the one that runs; one that comes in local mode, or without power, is ignored."""
        if not self.remote or self.robot_mode != RobotMode.RUNNING or self.safety_mode != SafetyMode.NORMAL:
            return
        self.loaded.append(text)
        if self.runtime == Runtime.PLAYING:
            self.stop_program()
        self._starting_at = self.now + START_S

    def stop_program(self) -> None:
        """End the program; the arm comes to rest."""
        self.runtime = Runtime.STOPPED
        self._brake()

    def protect(self, why: str) -> None:
        """Stop by the safety system: the program pauses, as after a protective stop."""
        if self.safety_mode in (SafetyMode.NORMAL, SafetyMode.REDUCED):
            self.safety_mode, self.why, self.stopped_at = SafetyMode.PROTECTIVE_STOP, why, self.now
            if self.runtime == Runtime.PLAYING:
                self.runtime = Runtime.PAUSED
            self._brake()

    def emergency_stop(self) -> None:
        """Press the button: the arm loses its power."""
        self.safety_mode, self.robot_mode, self.runtime = (
            SafetyMode.ROBOT_EMERGENCY_STOP, RobotMode.POWER_OFF, Runtime.STOPPED,
        )  # fmt: skip
        self._brake()

    def release_emergency_stop(self) -> None:
        """Turn the button back; power has to be switched on again."""
        if self.safety_mode == SafetyMode.ROBOT_EMERGENCY_STOP:
            self.safety_mode = SafetyMode.NORMAL

    def unlock(self) -> None:
        """Release a protective stop."""
        if self.safety_mode != SafetyMode.PROTECTIVE_STOP:
            raise Refused("Cannot unlock protective stop: no protective stop")
        if self.now < self.stopped_at + self.settings.unlock_s:
            raise Refused(
                "Cannot unlock protective stop until 5s after occurrence. "
                "Always inspect cause of protective stop before unlocking"
            )
        self.safety_mode, self.runtime = SafetyMode.NORMAL, Runtime.STOPPED

    def power_on(self) -> None:
        """Switch the arm on, with its brakes engaged."""
        self._demand_remote()
        if self.safety_mode != SafetyMode.NORMAL:
            raise Refused("Unable to power on: safety mode")
        if self.robot_mode == RobotMode.POWER_OFF:
            self.robot_mode = RobotMode.IDLE

    def power_off(self) -> None:
        """Switch the arm off."""
        self._demand_remote()
        self.lose(RobotMode.POWER_OFF)

    def lose(self, mode: RobotMode) -> None:
        """Lose power, or engage the brakes."""
        self.robot_mode, self.runtime = mode, Runtime.STOPPED
        self._brake()

    def release_brakes(self) -> None:
        """Switch the arm on and release its brakes."""
        self.power_on()
        self.become_ready()

    def become_ready(self) -> None:
        """Have power and no brakes, as after somebody has pressed the buttons at the panel."""
        self.robot_mode = RobotMode.RUNNING

    def restart_safety(self) -> None:
        """Leave a fault, with the power off."""
        self._demand_remote()
        self.safety_mode, self.robot_mode = SafetyMode.NORMAL, RobotMode.POWER_OFF

    def tare(self) -> None:
        """Let the wrench that is measured now be 0."""
        self.zero = self.zero + self._on_flange()

    def outputs(self) -> dict[str, Value]:
        """Return what clients may want to know, by field; what is left out is 0."""
        plant, motion = self.plant, self.motion
        pose = self.flange()
        status = (self.robot_mode == RobotMode.RUNNING) | (self.runtime == Runtime.PLAYING) << 1
        return self.registers | {
            "timestamp": self.now,
            "target_q": motion.q.tolist(),
            "target_qd": motion.dq.tolist(),
            "actual_q": plant.q.tolist(),
            "actual_qd": plant.dq.tolist(),
            "target_moment": plant.effort.tolist(),
            "actual_current": (plant.effort / 10.0).tolist(),
            "actual_current_as_torque": plant.effort.tolist(),
            "actual_TCP_pose": write_pose(pose, self.tcp[:3]),
            "actual_TCP_force": self.wrench.tolist(),
            "ft_raw_wrench": self._raw().tolist(),
            "robot_mode": int(self.robot_mode),
            "safety_mode": int(self.safety_mode),
            "joint_mode": [253 if self.robot_mode == RobotMode.RUNNING else 252] * 6,
            "runtime_state": int(self.runtime),
            "robot_status_bits": int(status),
            "safety_status_bits": SAFETY_BITS[self.safety_mode],
            "speed_scaling": 1.0,
            "target_speed_fraction": self.slider,
            "actual_digital_input_bits": self.io.inputs,
            "actual_digital_output_bits": self.io.outputs,
            **{f"standard_analog_input{i}": value for i, value in enumerate(self.io.analog_inputs)},
            **{f"standard_analog_output{i}": 10.0 * value for i, value in enumerate(self.io.analog_outputs)},
            "payload": self.payload,
            "payload_cog": self.centre.tolist(),
            "tcp_offset": self.tcp.tolist(),
        }

    def flange(self) -> Array:
        """Return where the controller says that its flange is, (4, 4) in its base."""
        return flange_pose(self.plant.q)

    def _brake(self) -> None:
        self.motion.job = Hold() if not self.motion.dq.any() else Stop(STOPPING)

    def _demand_remote(self) -> None:
        if not self.remote:
            raise Refused("Command is not allowed due to safety reasons, the robot is not in remote control")

    def _raw(self) -> Array:
        """Return the wrench (6,) of the sensor at the flange, with weight and offset, along the flange's axes."""
        return self.plant.wrench_on_flange()[0] + np.array(self.settings.bias)

    def _on_flange(self) -> Array:
        """Return the wrench (6,) without the weight of the payload that was set, and without the offset at the tare."""
        weight = self.payload * self.plant.wrench_on_flange()[1]
        return self._raw() - np.concatenate([weight, np.cross(self.centre, weight)]) - self.zero

    def _measure(self) -> Array:
        """Return the wrench (6,) at the tool centre point, along the axes of the controller's base."""
        here, rotation = self._on_flange(), flange_pose(self.plant.q)[:3, :3]
        moment = here[3:] - np.cross(self.tcp[:3], here[:3])
        return np.concatenate([rotation @ here[:3], rotation @ moment])
