"""Where a mobile base stands at a workstation: at its pose, or beside it where that is stated."""

from __future__ import annotations

from math import degrees, radians
from typing import TYPE_CHECKING

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Pose, rotation_from_angles
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import STAND

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def read_stand(state: WorldState, place: str) -> Pose | None:
    """Return where a base stands in the frame of a workstation, None if nothing else than its pose is stated."""
    values = [state.value(place, name) if name in state.stored else None for name in STAND]
    if not any(isinstance(each, int | float) and each for each in values):
        return None
    x, y, yaw = (float(each) if isinstance(each, int | float) else 0.0 for each in values)
    return make_stand(x, y, radians(yaw))


def make_stand(x_m: float, y_m: float, yaw_rad: float) -> Pose:
    """Return a pose on the floor beside that of a workstation, in its frame."""
    return Pose(np.array([x_m, y_m, 0.0]), rotation_from_angles(0.0, 0.0, yaw_rad))


def standing_pose(state: WorldState, place: str) -> Pose:
    """Return where a base stands in the world that has driven to a place; FrameError as for `pose`."""
    stand = read_stand(state, place)
    return pose(state, place) if stand is None else pose(state, place) @ stand


def stand_changes(place: str, x_m: float, y_m: float, yaw_rad: float) -> list[SetProperty]:
    """Return the changes that state where bases stand at a place, in its frame."""
    return [SetProperty(place, name, value) for name, value in zip(STAND, (x_m, y_m, degrees(yaw_rad)), strict=True)]
