"""Keeps the command of a control law until it is sent to a device."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.control_process.link import KINDS, make_command
from skillc_runtime.backends.simulation.motors import Joints, Motors
from skillc_runtime.devices.arm import Command, JointPosition, JointVelocity, Mode, Torque, command_values

MODES: Final[dict[type[Command], Mode]] = {Torque: "torque", JointPosition: "position", JointVelocity: "velocity"}
NOTHING: Final = float(KINDS.index("nothing"))


class CommandSlot(Motors):
    """Implements `Motors` for a device, which moves its joints and holds them by itself.

    command_for_device: the last one.
    """

    def __init__(self, joints: Joints, modes: tuple[Mode, ...], timestep_s: float) -> None:
        super().__init__(joints, modes, timestep_s)
        self.command_for_device = make_command(joints.q.size)

    def _take(self, command: Command) -> None:
        if MODES[type(command)] != self.mode:
            self._refuse(command)
        self.command_for_device.values[:] = command_values(command)
        self.command_for_device.kind[0] = KINDS.index(self.mode)

    def _rest(self) -> None:
        self.command_for_device.kind[0] = NOTHING

    def _hold(self, first: bool) -> None:
        """Do nothing: the device holds itself."""
