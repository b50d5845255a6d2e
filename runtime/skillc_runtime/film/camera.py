"""Cameras: a view that frames points, one that the work can be seen from, and where points are in a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import radians, tan
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array

FOVY_DEG = 45.0
"""Vertical angle of view, MuJoCo's."""

MARGIN = 0.06
"""Share of a picture that is left free at each edge."""

AZIMUTHS_DEG = tuple(range(-180, 180, 20))
ELEVATIONS_DEG = (-16.0, -28.0)

THERE_M = 0.03
"""A ray from the camera sees a point if it meets nothing until this distance from it."""

CLOSE_WEIGHT, TURN_WEIGHT, FACE_WEIGHT = 0.25, 0.3, 1.0
"""How much it counts that the camera is close, has turned, and looks on a face, relative to the points that it sees."""


@dataclass(frozen=True, slots=True)
class CameraView:
    """A camera that looks at a point (3,) in m of the world from `distance` m."""

    point: Array
    distance: float
    azimuth_deg: float
    elevation_deg: float

    @property
    def axes(self) -> Array:
        """The camera's directions (3, 3) in the world, one a row: right, up, forward."""
        azimuth, elevation = radians(self.azimuth_deg), radians(self.elevation_deg)
        forward = np.array(
            [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
        )
        right = np.array([np.sin(azimuth), -np.cos(azimuth), 0.0])
        return np.stack([right, np.cross(right, forward), forward])

    def is_same(self, other: CameraView) -> bool:
        """Whether another view shows the same."""
        angles = (self.distance, self.azimuth_deg, self.elevation_deg)
        same = angles == (other.distance, other.azimuth_deg, other.elevation_deg)
        return same and bool((self.point == other.point).all())

    @property
    def position(self) -> Array:
        """Where the camera is, (3,) m in the world."""
        return np.asarray(self.point - self.distance * self.axes[2])


@dataclass(frozen=True, slots=True)
class Projection:
    """A view with an angle in degrees over the height of a picture of width x height pixels."""

    view: CameraView
    fovy_deg: float
    width: int
    height: int

    def pixel(self, point: Array) -> tuple[float, float] | None:
        """Return the column and row at which a point (3,) of the world is seen; None for one behind the camera."""
        right, up, ahead = self.view.axes @ (point - self.view.position)
        if ahead <= 0:
            return None
        scale = self.height / 2 / tan(radians(self.fovy_deg) / 2) / ahead
        return self.width / 2 + scale * right, self.height / 2 - scale * up


def frame_points(points: Array, azimuth_deg: float, elevation_deg: float, aspect: float) -> CameraView:
    """Return the closest view in a direction in which all points (n, 3) are in a picture of that width by height."""
    view = CameraView(np.zeros(3), 0.0, azimuth_deg, elevation_deg)
    right, up, ahead = (points @ view.axes.T).T
    vertical = tan(radians(FOVY_DEG) / 2) * (1 - 2 * MARGIN)
    x, from_x = _fit(right, ahead, vertical * aspect)
    y, from_y = _fit(up, ahead, vertical)
    middle = float(ahead.min() + ahead.max()) / 2
    distance = middle - min(from_x, from_y)
    return CameraView(np.array([x, y, middle]) @ view.axes, distance, azimuth_deg, elevation_deg)


def _fit(across: Array, ahead: Array, slope: float) -> tuple[float, float]:
    """Return where a camera is across and ahead that sees all points at most at a slope to either side.

    The camera at (c, d) sees a point if |across - c| <= slope (ahead - d).
    """
    low, high = float((across - slope * ahead).max()), float((across + slope * ahead).min())
    return (low + high) / 2, (high - low) / 2 / slope


def choose_view(
    model: Any,
    states: Sequence[Any],
    targets: Sequence[Array],
    points: Array,
    aspect: float,
    before: CameraView | None = None,
    normals: Sequence[Array] = (),
) -> CameraView:
    """Return the view of points (n, 3) from which most targets (m, 3), one array a state, are seen from close by.

    A view in nearly the same direction as that `before` is preferred, and one on the faces with these normals (3,).
    """
    views = [frame_points(points, azimuth, up, aspect) for azimuth in AZIMUTHS_DEG for up in ELEVATIONS_DEG]
    closest = min(view.distance for view in views)

    def rate(view: CameraView) -> float:
        seen = [is_seen(model, data, view, each) for data, at in zip(states, targets, strict=True) for each in at]
        facing = FACE_WEIGHT * min((float(-view.axes[2] @ each) for each in normals), default=0.0)
        turned = 0.0 if before is None else abs(_turn_deg(before, view)) / 180.0
        return float(np.mean(seen)) + CLOSE_WEIGHT * closest / view.distance - TURN_WEIGHT * turned + facing

    return max(views, key=rate)


def blend_views(one: CameraView, other: CameraView, share: float) -> CameraView:
    """Return a view between two: the first one at share 0, the other one at 1."""
    return CameraView(
        (1 - share) * one.point + share * other.point,
        one.distance ** (1 - share) * other.distance**share,
        one.azimuth_deg + share * _turn_deg(one, other),
        (1 - share) * one.elevation_deg + share * other.elevation_deg,
    )


def _turn_deg(one: CameraView, other: CameraView) -> float:
    """Return the angle from the azimuth of one view to that of another, from -180 to 180 degrees."""
    return (other.azimuth_deg - one.azimuth_deg + 180.0) % 360.0 - 180.0


def is_seen(model: Any, data: Any, view: CameraView, point: Array) -> bool:
    """Whether nothing is between the camera and a point (3,)."""
    way = point - view.position
    length = float(np.linalg.norm(way))
    met = np.zeros(1, dtype=np.int32)
    distance = mujoco.mj_ray(model, data, view.position, way / length, None, True, -1, met)
    return bool(distance < 0 or distance > length - THERE_M)
