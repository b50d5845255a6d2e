"""The commands that the arms of a dry run would have got."""

from __future__ import annotations

from typing import Protocol

import msgspec
import numpy as np

from skillc_runtime.devices.arm import ArmLimits, Mode
from skillc_runtime.motion.pose import Array

UNITS: dict[Mode, str] = {"torque": "N m", "position": "rad", "velocity": "rad/s"}


class RecordedCommands(msgspec.Struct, frozen=True):
    """The commands of one arm: `values` (n, nv) in N m, rad or rad/s at `times_s` (n,); `altered` by limits were so
    many."""

    arm: str
    mode: Mode
    joints: tuple[str, ...]
    limits: ArmLimits
    times_s: Array
    values: Array
    altered: int

    @property
    def shares(self) -> Array:
        """The greatest share (nv,) of its limit of torque, or of speed, that each joint was commanded; 0 for none."""
        if self.mode == "torque":
            reached, most = self.values, self.limits.effort
        elif self.mode == "velocity":
            reached, most = self.values, self.limits.velocity
        else:
            steps = np.diff(self.times_s)[:, None]
            reached, most = np.diff(self.values, axis=0) / steps, self.limits.velocity
        greatest: Array = np.abs(reached).max(axis=0, initial=0.0) / most
        return greatest


class CommandRecord(Protocol):
    """Keeps what would be sent."""

    def commands(self) -> tuple[RecordedCommands, ...]:
        """Return the commands of all arms, in the order of their names."""
        ...
