"""Keeps the command of a control law until it is sent to a device."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.control_process.link import KINDS, make_command
from skillc_runtime.backends.simulation.arms.motors import Joints, Motors
from skillc_runtime.devices.arm import Command, Mode
from skillc_runtime.motion.numerics.program import Rows
from skillc_runtime.motion.pose import Array

NOTHING: Final = float(KINDS.index("nothing"))


class CommandSlot(Motors):
    """Implements `Motors` for a device, which moves its joints and holds them by itself.

    command_for_device: the last one.
    """

    def __init__(self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float) -> None:
        super().__init__(joints, modes, timestep_s)
        self.command_for_device = make_command(joints.q.size)

    def command(self, command: Command) -> None:
        """Keep a command for the next control period; TypeError for another kind than the mode."""
        super().command(command)
        self.command_for_device.kind[0] = KINDS.index(self.mode)

    def taking(self, values: Array) -> Rows | None:
        """Return None: Python says what kind of command it is."""
        return None

    @property
    def _target(self) -> tuple[Array, float]:
        return self.command_for_device.values, 0.0

    def _rest(self) -> None:
        self.command_for_device.kind[0] = NOTHING

    def _hold(self, first: bool) -> None:
        """Do nothing: the device holds itself."""
