"""Writes what the tool shall do into a command, for a device whose own controller holds and pushes the tool."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.control_process.link import KINDS, CommandView
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.motion.reference import Compliance, Reference

TOOL: Final = float(KINDS.index("tool"))


def fill_tool(command: CommandView, on_flange: Pose) -> None:
    """Write where the tool centre point is on the flange."""
    command.on_flange[:3], command.on_flange[3:] = on_flange.position, quaternion_from_rotation(on_flange.rotation)


def fill_target(command: CommandView, reference: Reference, compliance: Compliance) -> None:
    """Write reference and compliance of the tool, in the axes of the arm's base."""
    pose, rotation = reference.pose, reference.pose.rotation
    command.kind[0] = TOOL
    command.pose[:3], command.pose[3:] = pose.position, quaternion_from_rotation(rotation)
    command.twist[:] = reference.twist
    command.axes[:] = quaternion_from_rotation(rotation @ compliance.frame)
    command.stiffness[:], command.push[:] = compliance.stiffness, compliance.wrench
