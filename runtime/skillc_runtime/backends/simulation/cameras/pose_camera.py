"""A simulated camera that estimates poses: true poses with errors, of what is in view and not hidden."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from math import inf
from typing import Any, Final

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.cameras.camera_spec import CameraErrors, CameraSpec, make_imperfections
from skillc_runtime.backends.simulation.imperfections import Imperfection, distort
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.devices.camera import PoseEstimate
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array, Pose, exp

KEPT: Final = 50
"""How many estimates of an object are kept."""

INNER: Final = 0.9
"""The points of an object that must be visible lie at this share of the way from its middle to its corners."""

NEAR_M: Final = 0.002
"""A ray that ends this close to a point has reached it."""


class SimulatedPoseCamera:
    """Implements `PoseCamera`; an image is taken when somebody asks and the last one is older than the period."""

    def __init__(self, spec: CameraSpec, names: Mapping[str, str], model: Any, data: Any, seed: int | None) -> None:
        """Use the errors that follow from a seed; without a seed there are none."""
        self._spec, self._names, self._model, self._data = spec, names, model, data
        self._errors = CameraErrors() if seed is None else spec.errors
        self._imperfections: tuple[Imperfection, ...] = (
            () if seed is None else make_imperfections(self._errors, spec.individual, seed)
        )
        self._rng = rng_for(spec.individual, seed or 0, 1)
        self._found: dict[str, deque[PoseEstimate]] = {}
        self._next: dict[str, float] = {}

    @property
    def clock_s(self) -> float:
        """The simulated time in s."""
        return float(self._data.time)

    def locate(self, thing: str, since_s: float) -> PoseEstimate | None:
        """Return the newest estimate of an object from images taken at `since_s` or later; None if there is none."""
        now, found = self.clock_s, self._found.setdefault(thing, deque(maxlen=KEPT))
        if now >= self._next.get(thing, 0.0):
            self._next[thing] = now + self._spec.period_s
            estimate = self._take_image(thing, now)
            if estimate is not None:
                found.append(estimate)
        arrived = (each for each in reversed(found) if since_s <= each.taken_s <= now - self._spec.delay_s + 1e-9)
        return next(arrived, None)

    def depth_m(self, towards: Array) -> float | None:
        """Return the distance in m of the first thing on the ray towards a point (3,); None without view or image."""
        error = distort(np.zeros(6), self._imperfections)
        if error is None or self._spec.view.obstacle(towards):
            return None
        away = float(self._ray(self._spec.pose.rotation @ towards)[0])
        return away + float(error[2]) if away >= 0 else inf

    def _take_image(self, thing: str, now: float) -> PoseEstimate | None:
        """Return what an estimator makes of an image at `now` in s; None if it does not find the object."""
        errors = self._errors
        if self._rng.random() < errors.false_alarm:
            return PoseEstimate(self._false_pose(), now, errors.position_noise_m, errors.angle_noise_rad)
        body = self._body(thing)
        if body is None or not self._is_visible(body):
            return None
        error = distort(np.zeros(6), self._imperfections)
        if error is None:
            return None
        true = self._spec.pose.inverse() @ Pose(
            self._data.xpos[body].copy(), self._data.xmat[body].reshape(3, 3).copy()
        )
        pose = Pose(true.position + error[:3], exp(error[3:]) @ true.rotation)
        return PoseEstimate(pose, now, errors.position_noise_m, errors.angle_noise_rad)

    def _body(self, thing: str) -> int | None:
        """Return the body in the model whose frame is that of an object; None if it has none."""
        name = self._names.get(thing, "")
        for each in (part_name(name, "block"), name):
            found = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_BODY, each)
            if found > 0:
                return int(found)
        return None

    def _is_visible(self, body: int) -> bool:
        """Whether the middle of a body is in view, and enough of it is not hidden by others."""
        own = self._geoms(body)
        points = np.concatenate([self._points(geom) for geom in own]) if own else np.empty((0, 3))
        if not points.size or self._spec.view.obstacle(self._spec.pose.inverse().apply(points.mean(axis=0))):
            return False
        return float(np.mean([self._sees(point, own) for point in points])) >= self._spec.least_visible

    def _geoms(self, body: int) -> tuple[int, ...]:
        """Return the geoms of a body and of the bodies that are attached to it which are not transparent."""
        model = self._model
        belongs = model.body_rootid[model.geom_bodyid] == model.body_rootid[body]
        return tuple(np.flatnonzero(belongs & (model.geom_rgba[:, 3] > 0)).tolist())

    def _points(self, geom: int) -> Array:
        """Return points (8, 3) of a geom in the world, near the corners of its bounding box."""
        middle, half = self._model.geom_aabb[geom][:3], self._model.geom_aabb[geom][3:]
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        rotation = self._data.geom_xmat[geom].reshape(3, 3)
        return np.asarray((middle + INNER * half * signs) @ rotation.T + self._data.geom_xpos[geom])

    def _sees(self, point: Array, own: tuple[int, ...]) -> bool:
        """Whether nothing but the object itself is between the camera and a point (3,) of it."""
        way = point - self._spec.pose.position
        reached, hit = self._ray(way)
        return reached < 0 or hit in own or reached > float(np.linalg.norm(way)) - NEAR_M

    def _ray(self, way: Array) -> tuple[float, int]:
        """Return how far away the first geom is along a direction (3,) in the world, in m, below 0 if there is none."""
        hit = np.zeros(1, dtype=np.int32)
        along = way / np.linalg.norm(way)
        reached = mujoco.mj_ray(self._model, self._data, self._spec.pose.position, along, None, 1, -1, hit)
        return float(reached), int(hit[0])

    def _false_pose(self) -> Pose:
        """Return a pose somewhere in view, in the frame of the camera."""
        view, rng = self._spec.view, self._rng
        angle, around = rng.uniform(0.0, view.angle_rad / 2), rng.uniform(0.0, 2 * np.pi)
        direction = np.array([np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around), np.cos(angle)])
        return Pose(rng.uniform(view.near_m, view.far_m) * direction, exp(rng.uniform(-1.0, 1.0, 3) * np.pi))
