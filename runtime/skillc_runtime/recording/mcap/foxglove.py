"""What a cell looks like, for Foxglove: the shapes of its bodies once, then where they are and how tools press."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import sqrt
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.mcap import foxglove_types as fox
from skillc_runtime.recording.signals.channels import WORLD

SCENE, FIXED, MOVING, FORCES = "/scene", "/fixed_frames", "/frames", "/forces"
"""The topics of shapes, of bodies that never move, of those that may, and of contact forces."""

SHOWN_GROUPS = 3
"""MuJoCo shows the first groups of geoms; those of others are for collisions only."""

M_PER_N, SHAFT_M, HEAD_M, FEWEST_N = 0.005, 0.006, 0.015, 0.05
"""Arrows of forces: length, thickness, size of the head; weaker forces have none."""

_RED, _DIGITS, _HALF = fox.Color(0.85, 0.15, 0.1, 1.0), 5, sqrt(0.5)
_Geom = mujoco.mjtGeom


class ScenePicture:
    """The frames and the shapes of a model, an `mujoco.MjModel`."""

    def __init__(self, model: Any) -> None:
        self._model = model
        self._names = [model.body(body).name or f"body {body}" for body in range(model.nbody)]
        moving = [model.body_weldid[body] != 0 or model.body_mocapid[body] >= 0 for body in range(model.nbody)]
        self._moving = tuple(int(each) for each in np.flatnonzero(moving))
        self._fixed = tuple(body for body in range(1, model.nbody) if not moving[body])

    def shapes(self, time_s: float) -> fox.SceneUpdate:
        """Return the shapes of all bodies."""
        timestamp, entities = _time(time_s), []
        for body, name in enumerate(self._names):
            geoms = [each for each in range(self._model.ngeom) if self._is_shown(each, body)]
            if geoms:
                frame = WORLD if body == 0 else name
                entities.append(self._describe(fox.SceneEntity(timestamp=timestamp, frame_id=frame, id=name), geoms))
        return fox.SceneUpdate([], entities)

    def fixed_frames(self, time_s: float, positions: Array, quaternions: Array) -> fox.FrameTransforms:
        """Return where the bodies are that never move; positions (n, 3) m, quaternions (n, 4)."""
        (frames,) = self._frames(self._fixed, (time_s,), positions[None], quaternions[None])
        return frames

    def moving_frames(
        self, times_s: Sequence[float], positions: Array, quaternions: Array
    ) -> Iterator[fox.FrameTransforms]:
        """Yield where the other bodies are at some times; positions (k, n, 3) m, quaternions (k, n, 4)."""
        return self._frames(self._moving, times_s, positions, quaternions)

    def _frames(
        self, bodies: Sequence[int], times_s: Sequence[float], positions: Array, quaternions: Array
    ) -> Iterator[fox.FrameTransforms]:
        chosen, names = list(bodies), [self._names[body] for body in bodies]
        translations, rotations = (each[:, chosen].round(_DIGITS).tolist() for each in (positions, quaternions))
        for time_s, places, turns in zip(times_s, translations, rotations, strict=True):
            timestamp = _time(time_s)
            yield fox.FrameTransforms(
                [
                    fox.FrameTransform(timestamp, WORLD, name, fox.Vector3(*at), fox.Quaternion(x, y, z, w))
                    for name, at, (w, x, y, z) in zip(names, places, turns, strict=True)
                ]
            )

    def _is_shown(self, geom: int, body: int) -> bool:
        model = self._model
        is_visible = model.geom_group[geom] < SHOWN_GROUPS and model.geom_rgba[geom, 3] > 0
        return bool(model.geom_bodyid[geom] == body and is_visible and model.geom_type[geom] != _Geom.mjGEOM_PLANE)

    def _describe(self, entity: fox.SceneEntity, geoms: Sequence[int]) -> fox.SceneEntity:
        """Return an entity with the shapes of geoms: a mesh is its box."""
        model = self._model
        cubes, spheres, cylinders = list(entity.cubes), list(entity.spheres), list(entity.cylinders)
        for geom in geoms:
            size, color = model.geom_size[geom], fox.Color(*_round(model.geom_rgba[geom].tolist()))
            pose = _pose(model.geom_pos[geom], model.geom_quat[geom])
            match model.geom_type[geom]:
                case _Geom.mjGEOM_BOX:
                    cubes.append(fox.CubePrimitive(pose, _vector((2 * size).tolist()), color))
                case _Geom.mjGEOM_SPHERE | _Geom.mjGEOM_ELLIPSOID:
                    radii = size if model.geom_type[geom] == _Geom.mjGEOM_ELLIPSOID else np.full(3, size[0])
                    spheres.append(fox.SpherePrimitive(pose, _vector((2 * radii).tolist()), color))
                case _Geom.mjGEOM_CYLINDER | _Geom.mjGEOM_CAPSULE:
                    extent = 2 * np.array([size[0], size[0], size[1]])
                    cylinders.append(fox.CylinderPrimitive(pose, _vector(extent.tolist()), 1.0, 1.0, color))
                case _:
                    centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
                    rotation = _rotate(model.geom_quat[geom], centre)
                    pose = _pose(model.geom_pos[geom] + rotation, model.geom_quat[geom])
                    cubes.append(fox.CubePrimitive(pose, _vector((2 * half).tolist()), color))
        return fox.SceneEntity(
            timestamp=entity.timestamp,
            frame_id=entity.frame_id,
            id=entity.id,
            cubes=cubes,
            spheres=spheres,
            cylinders=cylinders,
        )


def describe_forces(time_s: float, faces: Sequence[tuple[str, Array]]) -> fox.SceneUpdate:
    """Return the contact forces on tools, each with its name and face (8,): force in N, position in m, quaternion.

    A force is an arrow from the face into the tool, which is how the contact pushes it.
    """
    timestamp = _time(time_s)
    return fox.SceneUpdate(
        [],
        [
            fox.SceneEntity(timestamp=timestamp, frame_id=WORLD, id=f"force on {tool}", arrows=list(_arrows(face)))
            for tool, face in faces
        ],
    )


def _arrows(face: Array) -> Iterator[fox.ArrowPrimitive]:
    force, *place = face.tolist()
    if abs(force) >= FEWEST_N:
        w, x, y, z = place[3:]
        turned = [_HALF * each for each in (w - y, x - z, w + y, x + z)]  # by 90 degrees about y, which turns x to -z
        pose = fox.Pose(_vector(place[:3]), _quaternion(turned))
        yield fox.ArrowPrimitive(pose, round(abs(force) * M_PER_N, _DIGITS), SHAFT_M, HEAD_M, HEAD_M, _RED)


def _time(time_s: float) -> fox.Time:
    nanoseconds = round(time_s * 1e9)
    return fox.Time(nanoseconds // 10**9, nanoseconds % 10**9)


def _rotate(quaternion: Array, vector: Array) -> Array:
    rotated = np.zeros(3)
    mujoco.mju_rotVecQuat(rotated, vector, quaternion)
    return rotated


def _pose(position: Array, quaternion: Array) -> fox.Pose:
    return fox.Pose(_vector(position.tolist()), _quaternion(quaternion.tolist()))


def _vector(values: Sequence[float]) -> fox.Vector3:
    return fox.Vector3(*_round(values))


def _quaternion(values: Sequence[float]) -> fox.Quaternion:
    w, x, y, z = _round(values)
    return fox.Quaternion(x, y, z, w)


def _round(values: Sequence[float]) -> list[float]:
    return [round(each, _DIGITS) for each in values]
