"""What drives with a mobile base: the things that its arms hold, and those that stand on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.gripper import ModelledGripper
from skillc_runtime.backends.simulation.names import base_body_name, part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation

STANDS_M = 0.003
"""Things at most this far from a base, or from what stands on it, stand on it."""


class Cargo:
    """The cargo of one mobile base: what touches it, or other cargo, when it starts to drive.

    Cargo neither slips nor tips while the base drives, whatever its acceleration.
    """

    def __init__(
        self,
        scene: SceneSpec,
        robot: str,
        hands: Mapping[str, ModelledGripper],
        model: Any,
        data: Any,
    ) -> None:
        """Prepare the cargo of a robot; `hands` are all grippers of the cell, by the IRI of their arm."""
        names = scene.names
        self._model, self._data = model, data
        self._own = [hands[arm.individual] for arm in scene.arms if arm.robot == robot and arm.individual in hands]
        self._all = tuple(hands.values())
        fixed = [names[body] for body, owner in scene.mounted.items() if owner == robot]
        self._base = _geoms(model, [base_body_name(names[robot]), *fixed])
        self._free = {each.individual: names[each.individual] for each in scene.graspable}
        self._loaded: list[int] | None = None

    def move(self, motion: Pose | None) -> None:
        """Move the cargo with the base, new = motion @ old in the world; None while the base is at rest."""
        if motion is None:
            self._loaded = None
            return
        if self._loaded is None:
            self._loaded = [int(self._model.joint(part_name(name, "free")).qposadr[0]) for name in self._standing()]
        for hand in self._own:
            hand.move_with_base(motion)
        for first in self._loaded:
            q = self._data.qpos[first : first + 7]
            moved = motion @ Pose.of(q[:3], q[3:])
            q[:3], q[3:] = moved.position, quaternion_from_rotation(moved.rotation)

    def _standing(self) -> list[str]:
        """Return the names of things that stand on the base or on each other, without what hands carry."""
        carried = {hand.carries for hand in self._all}
        free = [name for each, name in self._free.items() if each not in carried]
        left = {name: _geoms(self._model, [part_name(name, "block")]) for name in free}
        touching, found = list(self._base), list[str]()
        while near := [name for name, geoms in left.items() if self._touch(geoms, touching)]:
            found += near
            touching = [geom for name in near for geom in left.pop(name)]
        return found

    def _touch(self, ones: list[int], others: list[int]) -> bool:
        model, data, none = self._model, self._data, np.zeros(6)
        return any(
            mujoco.mj_geomDistance(model, data, one, other, 2 * STANDS_M, none) < STANDS_M
            for one in ones
            for other in others
        )


def _geoms(model: Any, bodies: Sequence[str]) -> list[int]:
    """Return the geoms of bodies, and of parts of these that move against them, such as the pad of a tool."""
    roots = {model.body(name).id for name in bodies}
    return [g for g in range(model.ngeom) if model.geom_bodyid[g] in roots or _free_root(model, g) in roots]


def _free_root(model: Any, geom: int) -> int:
    """Return the root body of a geom if it lies free, else -1."""
    root = int(model.body_rootid[model.geom_bodyid[geom]])
    first = int(model.body_jntadr[root])
    return root if first >= 0 and model.jnt_type[first] == mujoco.mjtJoint.mjJNT_FREE else -1
