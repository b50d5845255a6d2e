"""What a reader of robots' models returns."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from skillc.services.robot_import.comparison import Mechanism
from skillc.services.robot_import.robot_model import RobotModel
from skillc_runtime.motion.pose import Array, rotation_from_angles


@dataclass(frozen=True, slots=True)
class ReadOptions:
    """Which part of a file is the arm: the names of its ends, which are found if they are None.

    tip_turn: roll, pitch and yaw in degrees of the flange in the frame of the tip; correct_inertia: whether moments of
    inertia that no body can have are raised.
    """

    base: str | None = None
    tip: str | None = None
    tip_turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    correct_inertia: bool = False

    @property
    def turn(self) -> Array:
        """The rotation (3, 3) from the flange to the tip."""
        return rotation_from_angles(*np.radians(self.tip_turn).tolist())


@dataclass(frozen=True, slots=True)
class Reading:
    """A model, the file as a mechanism in MuJoCo, and what a user should know, as sentences."""

    model: RobotModel
    source: Mechanism
    notes: tuple[str, ...]

    def with_notes(self, *notes: str) -> Reading:
        """Return the reading with further notes."""
        return replace(self, notes=(*self.notes, *notes))
