"""What a control process publishes about its arm: one array of float64, in the axes of the arm's base."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Reference

Phase: TypeAlias = Literal["connected", "in-control", "lost"]
"""What a control process does: it reads the device, has control of it, or waits for it to be connected again."""

PHASES: Final[tuple[Phase, ...]] = ("connected", "in-control", "lost")

FIELDS: Final = {
    "time_s": "1", "stamp_s": "1", "phase": "1", "stopped": "1", "faulted": "1", "lost": "1", "late_s": "1",
    "busy_until_s": "1", "speed_share": "1", "done": "1", "stationary": "1", "at_rest": "1", "released": "1",
    "q": "n", "dq": "n", "bias": "n", "effort": "n", "position": "3", "rotation": "9", "jacobian": "6n", "mass": "nn",
    "wrench": "6", "felt": "6", "contact": "6", "reference": "24", "path_velocity": "3", "stiffness": "6", "force": "3",
    "push": "1", "pressed_s": "1",
}  # fmt: skip
"""The sizes of the fields of a snapshot in order, n being the number of joints.

time_s: when the cycle began, by the clock of the machine. stopped, faulted: 1 if there is a `DeviceStop`, or a reason
why the arm stopped by itself. lost: cycles so far in which the device has got no command, or sent no state. late_s: by
how much the cycle began later than a period after the one before. busy_until_s: until when at the latest a call to the
device keeps the loop from running. felt: NaN where nothing is felt. force: as `commanded_force`. push: the number of
the last push, 0 for none. Others: as in `ArmState`, `MotionInterface`, `ComplianceInterface` and `PushProgress`.
"""


class FieldLayout:
    """Where fields are in an array for an arm with so many joints; sizes are those of `FIELDS`."""

    def __init__(self, fields: Mapping[str, str], joints: int) -> None:
        sizes = [_count(size, joints) for size in fields.values()]
        ends = np.cumsum(sizes).tolist()
        self.joints, self.size = joints, int(ends[-1])
        self.spans = {name: slice(end - size, end) for name, size, end in zip(fields, sizes, ends, strict=True)}


def _count(size: str, joints: int) -> int:
    """Return the number that a size such as "6n" stands for."""
    count = int(size.rstrip("n") or 1)
    for _ in range(size.count("n")):
        count *= joints
    return count


@dataclass(frozen=True, slots=True)
class ControlSnapshot:
    """A copy of what a control process has published."""

    layout: FieldLayout
    values: Array

    def field(self, name: str) -> Array:
        """Return a field as an array."""
        field: Array = self.values[self.layout.spans[name]]
        return field

    def number(self, name: str) -> float:
        """Return a field that is one number."""
        return float(self.values[self.layout.spans[name].start])

    def holds(self, name: str) -> bool:
        """Tell whether a field that is 0 or 1 is 1."""
        return self.number(name) > 0.0

    @property
    def phase(self) -> Phase:
        """What the process did when it wrote that."""
        return PHASES[int(self.number("phase"))]

    @property
    def state(self) -> ArmState:
        """The measurement."""
        joints, field = self.layout.joints, self.field
        return ArmState(
            q=field("q"),
            dq=field("dq"),
            tool=Pose(field("position"), field("rotation").reshape(3, 3)),
            jacobian=field("jacobian").reshape(6, joints),
            mass_matrix=field("mass").reshape(joints, joints),
            bias=field("bias"),
            wrench=field("wrench"),
            effort=field("effort"),
        )

    @property
    def felt(self) -> Array | None:
        """The wrench (6,) that is felt, N and N m, base axes; None where nothing is."""
        felt = self.field("felt")
        return None if np.isnan(felt[0]) else felt

    @property
    def reference(self) -> Reference:
        """The reference of the tool in base."""
        return Reference(self.field("reference").reshape(8, 3))
