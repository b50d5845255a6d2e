"""The motors of a simulated arm: torque motors, or servos that take positions or speeds."""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import ceil
from typing import ClassVar, Final

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.arms.command_link import CommandLink
from skillc_runtime.backends.simulation.arms.motor_memory import (
    LEFT,
    SILENT,
    LateTaking,
    MotorMemory,
    Taking,
    approach,
    exert,
    pursue,
    take_command,
    take_late_command,
)
from skillc_runtime.devices.arm import (
    Command,
    JointPosition,
    JointVelocity,
    Mode,
    ModeRefused,
    Torque,
    command_values,
)
from skillc_runtime.motion.arrays import Vector
from skillc_runtime.motion.numerics.compiled import Bound, bind
from skillc_runtime.motion.numerics.program import Rows, row_of
from skillc_runtime.motion.pose import Array

COMMAND_TIMEOUT_S = 0.05
"""Time without command after which an arm holds still by itself."""

COMMANDS: Final = {"torque": Torque, "position": JointPosition, "velocity": JointVelocity}
"""The kinds of commands by mode."""

HOLD_RATE = 20.0
"""1/s: natural frequency, critically damped, with which a torque-controlled arm holds its joints by itself."""


class Joints(msgspec.Struct, frozen=True):
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
    """Take commands of one mode at a time, and hold still if none has arrived for `COMMAND_TIMEOUT_S`.

    They are a part of the steps of a cell. `link` is the line that brings the commands; None if they come at once.
    """

    def __init__(self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float) -> None:
        self.joints, self.modes, self.mode = joints, modes, modes[0]
        self.link: CommandLink | None = None
        self._sent = np.zeros_like(joints.q)
        self._counts, self._timeout_steps = np.zeros(2), round(COMMAND_TIMEOUT_S / timestep_s)
        self._timestep: float = timestep_s
        self._takings: dict[tuple[Mode, int], tuple[Array, Bound[[float], int]]] = {}
        self._exert = bind(exert, self._memory(joints.control, np.ones_like(joints.q), np.zeros_like(joints.q)))

    @property
    def silent(self) -> bool:
        """Whether commands have stopped."""
        return bool(self._counts[SILENT] >= self._timeout_steps)

    def be_silent(self) -> None:
        """Hold still from the next step on, as if commands had stopped."""
        self._counts[SILENT] = self._timeout_steps

    def switch(self, mode: Mode) -> None:
        """Take commands of this kind from now on, at rest until the first; ModeRefused for an unknown one."""
        if mode not in self.modes:
            raise ModeRefused(f"the arm takes {' and '.join(self.modes)} commands, not {mode} commands")
        if mode != self.mode:
            self.mode = mode
            self._rest()

    def command(self, command: Command) -> None:
        """Take a command for the next control period; TypeError for another kind than the mode."""
        if not isinstance(command, COMMANDS[self.mode]):
            raise TypeError(f"a {self.mode} controlled arm takes no {type(command).__name__}")
        self._sent[:] = command_values(command)
        self._take(self._sent)(0.0)

    @property
    def rows(self) -> Rows | None:
        """The function that sets the actuators."""
        return row_of(self._drive)

    def step(self, now: float) -> bool:
        """Set the actuators for one step of the simulation."""
        events = self._drive(now)
        return events != 0 and self.act(events, now)

    def act(self, events: int, now: float) -> bool:
        """Hold still: commands have stopped."""
        self._hold(first=self._counts[SILENT] == self._timeout_steps + 1)
        return False

    def taking(self, values: Array) -> Rows | None:
        """Return the function that takes commands of the mode from there (nv,), which must stay; None without one."""
        return row_of(self._take(values))

    def _take(self, values: Array) -> Bound[[float], int]:
        key = self.mode, id(values)
        if key not in self._takings:
            target, steps = self._target
            taking = Taking(values, target, self._counts, steps)
            link = self.link
            bound = bind(take_command, taking) if link is None else bind(take_late_command, LateTaking(taking, link))
            self._takings[key] = values, bound
        return self._takings[key][1]

    @property
    def _drive(self) -> Bound[[float], int]:
        return self._exert

    def _memory(self, target: Array, lead: Array, farthest: Array) -> MotorMemory:
        joints = self.joints
        return MotorMemory(
            self._counts, self._timeout_steps, joints.control, joints.applied, joints.bias, joints.q, joints.dq,
            target, lead, farthest, self._timestep,
        )  # fmt: skip

    @property
    @abstractmethod
    def _target(self) -> tuple[Array, float]:
        """Where commands (nv,) of the mode are put, and how many steps they last."""

    @abstractmethod
    def _rest(self) -> None:
        """Discard the last command."""

    @abstractmethod
    def _hold(self, first: bool) -> None:
        """Hold still without commands; `first` in the first step after the timeout."""


class TorqueMotors(Motors):
    """Motors that exert the commanded torques. Without commands they carry the arm and brake each joint."""

    MODES: ClassVar[tuple[Mode, ...]] = ("torque",)

    def __init__(self, joints: Joints, timestep_s: float) -> None:
        super().__init__(joints, self.MODES, timestep_s)
        self._held_q = np.zeros_like(joints.q)

    @property
    def _target(self) -> tuple[Array, float]:
        return self.joints.control, 0.0

    def _rest(self) -> None:
        """Do nothing: there is no other mode."""

    def _hold(self, first: bool) -> None:
        joints = self.joints
        if first:
            self._held_q[:] = joints.q
        slowing = HOLD_RATE * (joints.q - self._held_q) + 2 * joints.dq
        joints.control[:] = joints.own_bias + joints.carrying - HOLD_RATE * joints.mass_matrix.diagonal() * slowing
        np.clip(joints.control, -joints.effort, joints.effort, out=joints.control)


class ServoGains(msgspec.Struct, frozen=True):
    """Of position servos, (nv,): stiffness N m/rad, damping N m s/rad."""

    stiffness: Vector
    damping: Vector


class Servos(Motors):
    """Servos that follow targets, like those of industrial arms; weight and Coriolis forces are compensated.

    tau = kp (target - q) - kv dq. With position commands the targets move linearly over the control period, and as much
    longer as a command may be late, so that one which is makes no jump; with speed
    commands they move at that speed, limited to a lead that needs the full effort. If a joint that is commanded to
    stand still needs the full effort, its target becomes its position, so it does not press against an obstacle.
    """

    def __init__(
        self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float, gains: ServoGains, steps_per_command: int
    ) -> None:
        """Hold the joints where they are."""
        super().__init__(joints, modes, timestep_s)
        self._steps_per_command = steps_per_command
        self._place, self._speed = joints.q.copy(), np.zeros_like(joints.q)
        self.gains = gains
        leads = gains.damping / gains.stiffness, joints.effort / gains.stiffness
        self._approach = bind(approach, self._memory(self._place, *leads))
        self._pursue = bind(pursue, self._memory(self._speed, *leads))
        joints.control[:] = joints.q

    @property
    def _drive(self) -> Bound[[float], int]:
        return self._pursue if self.mode == "velocity" else self._approach

    @property
    def _target(self) -> tuple[Array, float]:
        late = 0 if self.link is None else ceil(self.link.jitter_s / self._timestep)
        return self._place if self.mode == "position" else self._speed, float(self._steps_per_command + late)

    def _rest(self) -> None:
        """Keep the present targets."""
        self._speed[:], self._counts[LEFT] = 0.0, 0.0

    def _hold(self, first: bool) -> None:
        if first:
            self._rest()
        np.add(self.joints.own_bias, self.joints.carrying, out=self.joints.applied)
