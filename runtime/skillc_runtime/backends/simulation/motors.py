"""The motors of a simulated arm: torque motors, or servos that take positions or speeds."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar, NoReturn

import numpy as np

from skillc_runtime.devices.arm import Command, JointPosition, JointVelocity, Mode, ModeRefused, Torque
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.pose import Array

COMMAND_TIMEOUT_S = 0.05
"""Time without command after which an arm holds still by itself."""

HOLD_RATE = 20.0
"""1/s: natural frequency, critically damped, with which a torque-controlled arm holds its joints by itself."""


@dataclass(frozen=True, slots=True)
class Joints:
    """The joints of a simulated arm: views (nv,) in rad, rad/s, N m.

    control, applied: actuator commands, and additional torques, both written here. q, dq, own_bias: present values,
    without payload. bias: measured last, with payload; carrying: the part of it for the payload. mass_matrix (nv, nv):
    measured last, kg m^2. effort: greatest torque of the actuators.
    """

    control: Array
    applied: Array
    q: Array
    dq: Array
    own_bias: Array
    bias: Array
    carrying: Array
    mass_matrix: Array
    effort: Array


class Motors(ABC):
    """Take commands of one mode at a time, and hold still if none has arrived for `COMMAND_TIMEOUT_S`."""

    def __init__(self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float) -> None:
        self.joints, self.modes, self.mode = joints, modes, modes[0]
        self._steps_without_command, self._timeout_steps = 0, round(COMMAND_TIMEOUT_S / timestep_s)

    def switch(self, mode: Mode) -> None:
        """Take commands of this kind from now on, at rest until the first; ModeRefused for an unknown one."""
        if mode not in self.modes:
            raise ModeRefused(f"the arm takes {' and '.join(self.modes)} commands, not {mode} commands")
        if mode != self.mode:
            self.mode = mode
            self._rest()

    def command(self, command: Command) -> None:
        """Take a command for the next control period; TypeError for another kind than the mode."""
        self._take(command)
        self._steps_without_command = 0

    def before_step(self) -> None:
        """Set the actuators for one step of the simulation."""
        self._steps_without_command += 1
        if self._steps_without_command > self._timeout_steps:
            self._hold(first=self._steps_without_command == self._timeout_steps + 1)
        else:
            self._move()

    def _refuse(self, command: Command) -> NoReturn:
        raise TypeError(f"a {self.mode} controlled arm takes no {type(command).__name__}")

    @abstractmethod
    def _take(self, command: Command) -> None: ...

    @abstractmethod
    def _rest(self) -> None:
        """Discard the last command."""

    @abstractmethod
    def _move(self) -> None: ...

    @abstractmethod
    def _hold(self, first: bool) -> None:
        """Hold still without commands; `first` in the first step after the timeout."""


class TorqueMotors(Motors):
    """Motors that exert the commanded torques. Without commands they carry the arm and brake each joint."""

    MODES: ClassVar[tuple[Mode, ...]] = ("torque",)

    def __init__(self, joints: Joints, timestep_s: float) -> None:
        super().__init__(joints, self.MODES, timestep_s)
        self._held_q = np.zeros_like(joints.q)

    def _take(self, command: Command) -> None:
        if not isinstance(command, Torque):
            self._refuse(command)
        self.joints.control[:] = command.tau

    def _rest(self) -> None:
        """Do nothing: there is no other mode."""

    def _move(self) -> None:
        """Do nothing: torques were set by the command."""

    def _hold(self, first: bool) -> None:
        joints = self.joints
        if first:
            self._held_q[:] = joints.q
        slowing = HOLD_RATE * (joints.q - self._held_q) + 2 * joints.dq
        joints.control[:] = joints.own_bias + joints.carrying - HOLD_RATE * joints.mass_matrix.diagonal() * slowing
        np.clip(joints.control, -joints.effort, joints.effort, out=joints.control)


@dataclass(frozen=True, slots=True)
class ServoGains:
    """Of position servos, (nv,): stiffness N m/rad, damping N m s/rad."""

    stiffness: Vector
    damping: Vector


class Servos(Motors):
    """Servos that follow targets, like those of industrial arms; weight and Coriolis forces are compensated.

    tau = kp (target - q) - kv dq. With position commands the targets move linearly over the control period; with speed
    commands they move at that speed, limited to a lead that needs the full effort. If a joint that is commanded to
    stand still needs the full effort, its target becomes its position, so it does not press against an obstacle.
    """

    def __init__(
        self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float, gains: ServoGains, steps_per_command: int
    ) -> None:
        """Hold the joints where they are."""
        super().__init__(joints, modes, timestep_s)
        self._timestep, self._steps_per_command = timestep_s, steps_per_command
        self._target, self._steps_left = joints.q.copy(), 0
        self._speed = np.zeros_like(joints.q)
        self.gains = gains
        self._lead, self._farthest = gains.damping / gains.stiffness, joints.effort / gains.stiffness
        joints.control[:] = joints.q

    def _take(self, command: Command) -> None:
        match command:
            case JointPosition(q=q) if self.mode == "position":
                self._target[:], self._steps_left = q, self._steps_per_command
            case JointVelocity(dq=dq) if self.mode == "velocity":
                self._speed[:] = dq
            case _:
                self._refuse(command)

    def _rest(self) -> None:
        """Keep the present targets."""
        self._speed[:], self._steps_left = 0.0, 0

    def _move(self) -> None:
        joints = self.joints
        joints.applied[:] = joints.bias
        if self.mode == "velocity":
            update_servo_targets(
                joints.control, self._speed, joints.q, joints.dq, self._lead, self._farthest, self._timestep
            )
        elif self._steps_left > 0:
            self._approach()

    def _hold(self, first: bool) -> None:
        if first:
            self._rest()
        np.add(self.joints.own_bias, self.joints.carrying, out=self.joints.applied)

    def _approach(self) -> None:
        """Move the targets linearly so that they arrive in the last step of the control period."""
        control = self.joints.control
        if self._steps_left == 1:
            control[:] = self._target
        else:
            control += (self._target - control) / self._steps_left
        self._steps_left -= 1


@compiled
def update_servo_targets(
    control: OutVector, speed: Vector, q: Vector, dq: Vector, lead: Vector, farthest: Vector, timestep: float
) -> None:
    """Move the targets `control` (nv,) in rad of servos by speed (nv,) in rad/s for a simulation step in s.

    lead (nv,): kv / kp in s, by which a target is ahead of a joint that moves freely; farthest (nv,): rad, the further
    lead that needs the full effort. While all speeds are zero, the target of such a joint becomes its position.
    """
    still = True
    for j in range(q.size):
        still = still and speed[j] == 0.0
    for j in range(q.size):
        even = q[j] + lead[j] * dq[j]
        control[j] = min(max(control[j] + timestep * speed[j], even - farthest[j]), even + farthest[j])
        if still and abs(control[j] - even) >= farthest[j]:
            control[j] = q[j]
