"""How deep convex solids overlap; MuJoCo is imported when solids are compared, not before."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import quaternion_from_rotation
from skillc_runtime.world.space.shapes import Solid

FAR_M = 1.0
"""Beyond this distance no distance is computed."""


def overlap_depths(pairs: Sequence[tuple[Iterable[Solid], Iterable[Solid]]]) -> list[float]:
    """Return how deep things of convex solids in one frame overlap, in m: the deepest pair of solids; 0 if none do.

    The depth of a pair is the shortest way by which one of them has to be moved so that they are apart.
    """
    if not pairs:
        return []
    import mujoco

    spec, groups = mujoco.MjSpec(), list[tuple[list[int], list[int]]]()
    for one, other in pairs:
        groups.append((_add(spec, mujoco, one), _add(spec, mujoco, other)))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)

    def depth(one: int, other: int) -> float:
        return -float(mujoco.mj_geomDistance(model, data, one, other, FAR_M, None))

    return [max(0.0, *(depth(one, other) for one in ones for other in others)) for ones, others in groups]


def _add(spec: Any, mujoco: Any, solids: Iterable[Solid]) -> list[int]:
    """Add solids to a model, and return their numbers in it."""
    added = list[int]()
    for each in solids:
        x, y, z = each.half
        sizes = {"box": (x, y, z), "cylinder": (x, z, 0.0), "sphere": (x, 0.0, 0.0), "capsule": (x, z - x, 0.0)}
        kinds = mujoco.mjtGeom
        kind = {
            "box": kinds.mjGEOM_BOX,
            "cylinder": kinds.mjGEOM_CYLINDER,
            "sphere": kinds.mjGEOM_SPHERE,
            "capsule": kinds.mjGEOM_CAPSULE,
        }[each.kind]
        added.append(len(spec.geoms))
        spec.worldbody.add_geom(
            type=kind,
            size=np.array(sizes[each.kind]),
            pos=each.place.position,
            quat=quaternion_from_rotation(each.place.rotation),
        )
    return added
