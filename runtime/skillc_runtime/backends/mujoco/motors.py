"""How a simulated arm moves by itself: motors that take torques, or servos that take positions or speeds."""

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
"""An arm that is not commanded for so long holds still by itself."""

HOLD_RATE = 20.0
"""1/s: natural frequency, critically damped, with which an arm that takes torques holds its joints by itself."""


@dataclass(frozen=True, slots=True)
class Joints:
    """The joints of a simulated arm, live: arrays (nv,) in rad, rad/s, N m.

    control, applied: commands of their actuators, and torques beside theirs, both to be written. q, dq, own_bias: as
    they are, without payload. bias: as measured last, payload included; carrying: what of it carries the payload.
    mass_matrix (nv, nv): as measured last. effort: greatest torque of the actuators.
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
    """Take commands of one mode at a time, and hold still when none has come for `SILENCE_S`."""

    def __init__(self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float) -> None:
        self._joints, self.modes, self.mode = joints, modes, modes[0]
        self._unheard, self._patience = 0, round(COMMAND_TIMEOUT_S / timestep_s)

    def switch(self, mode: Mode) -> None:
        """Take commands of this kind from now on, at rest until the first; ModeRefused for one there is not."""
        if mode not in self.modes:
            raise ModeRefused(f"the arm takes {' and '.join(self.modes)} commands, not {mode} commands")
        if mode != self.mode:
            self.mode = mode
            self._rest()

    def command(self, command: Command) -> None:
        """Take a command for the next control period; TypeError for a kind the mode does not take."""
        self._take(command)
        self._unheard = 0

    def before_step(self) -> None:
        """Set the actuators for one step of the simulation."""
        self._unheard += 1
        if self._unheard > self._patience:
            self._hold(first=self._unheard == self._patience + 1)
        else:
            self._move()

    def _refuse(self, command: Command) -> NoReturn:
        raise TypeError(f"a {self.mode} controlled arm takes no {type(command).__name__}")

    @abstractmethod
    def _take(self, command: Command) -> None: ...

    @abstractmethod
    def _rest(self) -> None:
        """Forget what was commanded."""

    @abstractmethod
    def _move(self) -> None: ...

    @abstractmethod
    def _hold(self, first: bool) -> None:
        """Hold still without commands, for the `first` time since the last of them."""


class TorqueMotors(Motors):
    """Motors that exert what they are commanded. Left alone they carry the arm and brake each joint."""

    MODES: ClassVar[tuple[Mode, ...]] = ("torque",)

    def __init__(self, joints: Joints, timestep_s: float) -> None:
        super().__init__(joints, self.MODES, timestep_s)
        self._held = np.zeros_like(joints.q)

    def _take(self, command: Command) -> None:
        if not isinstance(command, Torque):
            self._refuse(command)
        self._joints.control[:] = command.tau

    def _rest(self) -> None:
        """There is no other mode to come from."""

    def _move(self) -> None:
        """The motors have been commanded already."""

    def _hold(self, first: bool) -> None:
        joints = self._joints
        if first:
            self._held[:] = joints.q
        slowing = HOLD_RATE * (joints.q - self._held) + 2 * joints.dq
        joints.control[:] = joints.own_bias + joints.carrying - HOLD_RATE * joints.mass_matrix.diagonal() * slowing
        np.clip(joints.control, -joints.effort, joints.effort, out=joints.control)


@dataclass(frozen=True, slots=True)
class ServoGains:
    """Of position servos, (nv,): stiffness N m/rad, damping N m s/rad."""

    stiffness: Array
    damping: Array


class Servos(Motors):
    """Servos that follow targets, like those of industrial arms; weight and Coriolis forces are compensated.

    tau = kp (target - q) - kv dq. Given positions, the targets move there evenly over the control period; given speeds,
    they move as fast as that, but no further ahead than takes all effort. Where it takes all and the arm is to
    stand still, the joint stays where it is, instead of pressing on against what is in its way.
    """

    def __init__(
        self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float, gains: ServoGains, steps_per_command: int
    ) -> None:
        """Hold the joints where they are."""
        super().__init__(joints, modes, timestep_s)
        self._timestep, self._steps_per_command = timestep_s, steps_per_command
        self._target, self._steps_left = joints.q.copy(), 0
        self._speed = np.zeros_like(joints.q)
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
        """Stay with the targets that there are."""
        self._speed[:], self._steps_left = 0.0, 0

    def _move(self) -> None:
        joints = self._joints
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
        np.add(self._joints.own_bias, self._joints.carrying, out=self._joints.applied)

    def _approach(self) -> None:
        """Move the targets so that they arrive with the last step of the control period."""
        control = self._joints.control
        if self._steps_left == 1:
            control[:] = self._target
        else:
            control += (self._target - control) / self._steps_left
        self._steps_left -= 1


@compiled
def update_servo_targets(
    control: OutVector, speed: Vector, q: Vector, dq: Vector, lead: Vector, farthest: Vector, timestep: float
) -> None:
    """Move the targets of servos by speed for a step of the simulation, in s; all else (nv,).

    lead: kv / kp, s, for which a target is ahead of a joint that moves freely; farthest: how much more takes all
    effort, rad. While all are commanded to stand still, the target of a joint that takes it all is where the joint is.
    """
    still = True
    for j in range(q.size):
        still = still and speed[j] == 0.0
    for j in range(q.size):
        even = q[j] + lead[j] * dq[j]
        control[j] = min(max(control[j] + timestep * speed[j], even - farthest[j]), even + farthest[j])
        if still and abs(control[j] - even) >= farthest[j]:
            control[j] = q[j]
