"""A simulated arm that takes commands as a control process sends them, within its limits, and keeps them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from skillc_runtime.backends.control_process.periods.command_limits import CommandLimits
from skillc_runtime.backends.control_process.periods.facts import read_rate_limits
from skillc_runtime.backends.mujoco.arm import SimulatedArm
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.arm import ArmState, Command, Mode, command_values
from skillc_runtime.devices.command_record import RecordedCommands
from skillc_runtime.motion.numerics.program import Rows
from skillc_runtime.motion.pose import Array

ALTERED = 1e-6
"""A command that differs by more, in N m, rad or rad/s, from what the law wants was altered by the limits."""


@dataclass(eq=False, slots=True)
class CommandKeeper:
    """Limits and keeps the commands of one arm, whose cycles are a period in s apart; `altered` counts those that the
    limits have changed."""

    facts: ArmSpec
    joints: tuple[str, ...]
    period_s: float
    altered: int = 0
    times_s: list[float] = field(default_factory=list)
    values: list[Array] = field(default_factory=list)
    _limits: CommandLimits | None = None

    def limit(self, command: Command, arm: SimulatedArm, measured: ArmState, now_s: float) -> Command:
        """Return a command within the limits, and keep it; ControlError if it is far beyond them."""
        wanted = command_values(command)
        if self._limits is None:
            self._limits = CommandLimits(arm.limits, read_rate_limits(self.facts), self.period_s)
            self._limits.begin(arm.interface, measured.q, measured.bias)
        limited = np.array(wanted)
        self._limits.apply(arm.interface, limited, measured.bias)
        self.altered += bool(np.abs(limited - wanted).max() > ALTERED)
        self.times_s.append(now_s)
        self.values.append(limited)
        return type(command)(limited)

    def collect(self, arm: SimulatedArm, name: str) -> RecordedCommands:
        """Return what was kept."""
        mode: Mode = arm.interface
        values = np.array(self.values).reshape(len(self.values), len(self.joints))
        return RecordedCommands(name, mode, self.joints, arm.limits, np.array(self.times_s), values, self.altered)


class DryArm(SimulatedArm):
    """An arm of a dry run; `keeper` limits and keeps its commands."""

    keeper: CommandKeeper

    def taking(self, values: Array) -> Rows | None:
        """Return None: each command is limited, and kept, in Python."""
        return None

    def command(self, command: Command) -> None:
        """Take a command as the device would get it."""
        super().command(self.keeper.limit(command, self, self._here, float(self._data.time)))
