"""What a camera can see, as far as is believed: a cone around its z axis, between two distances."""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.data_sheet import DataSheet, sheet_of

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class FieldOfView(msgspec.Struct, frozen=True):
    """A cone of the full `angle_rad` around the z axis of a camera, from `near_m` to `far_m` away from it."""

    angle_rad: float
    near_m: float
    far_m: float

    def obstacle(self, point: Array) -> str | None:
        """Return why a point (3,) in m in the frame of the camera is outside; None if it is inside."""
        away = float(np.linalg.norm(point))
        if not self.near_m <= away <= self.far_m:
            return f"it is {away:.2f} m away, the camera sees from {self.near_m:.2f} m to {self.far_m:.2f} m"
        angle, widest = float(np.arccos(np.clip(point[2] / away, -1.0, 1.0))) if away else pi, self.angle_rad / 2
        if angle > widest:
            return (
                f"it is {degrees(angle):.0f} deg off the camera's axis, the camera sees up to {degrees(widest):.0f} deg"
            )
        return None


def field_of_view(state: WorldState, camera: str) -> FieldOfView:
    """Return the field of view that the data sheet of a camera states; SheetError if it does not."""
    return read_field_of_view(sheet_of(state, camera))


def read_field_of_view(sheet: DataSheet) -> FieldOfView:
    """Return the field of view of a camera's data sheet; SheetError if a number is missing."""
    return FieldOfView(sheet.number("fieldOfView"), sheet.number("nearLimit"), sheet.number("farLimit"))
