"""How far the joints and mocap bodies of a model can move things: bounds for all postures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array

TURNS, SLIDES, MOVES_FREELY = 0.0, 1.0, 2.0
"""What a joint does, by its coordinates: an angle in rad, a way in m, or position and quaternion."""

KNOWN_JOINTS = {
    int(each) for each in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_FREE)
}

BEYOND_RANGE_M = 0.1
"""How far a slide is believed to move beyond its range, or from its rest position without one."""

Reach = dict[int, float]
"""By body: m, the greatest distance of anything that hangs on it, and of its own geoms, from its frame."""


def find_joints(model: Any) -> Iterator[tuple[float, ...]]:
    """Yield the first coordinate of each joint, its kind, its lever, and of slides rest position and greatest way.

    lever: m per rad, or 1, or of a free joint that of its rotation. All joints are of `KNOWN_JOINTS`.
    """
    reach = find_reach(model)
    for joint in range(model.njnt):
        body, first = int(model.jnt_bodyid[joint]), int(model.jnt_qposadr[joint])
        match int(model.jnt_type[joint]):
            case mujoco.mjtJoint.mjJNT_FREE:
                yield first, MOVES_FREELY, reach[body], 0.0, 0.0
            case mujoco.mjtJoint.mjJNT_SLIDE:
                yield first, SLIDES, 1.0, float(model.qpos0[first]), _longest_way(model, joint)
            case _:
                lever = float(np.linalg.norm(model.jnt_pos[joint])) + _own_way(model, body) + reach[body]
                yield first, TURNS, lever, 0.0, 0.0


def find_mocap_levers(model: Any) -> Array:
    """Return, by mocap body, the greatest distance (n,) in m of what it carries from its frame."""
    reach = find_reach(model)
    carriers = sorted(np.flatnonzero(model.body_mocapid >= 0), key=lambda body: int(model.body_mocapid[body]))
    return np.array([reach[int(body)] for body in carriers])


def find_reach(model: Any) -> Reach:
    """Return the reach of all bodies."""
    reach = dict.fromkeys(range(model.nbody), 0.0)
    for geom in range(model.ngeom):
        body, centre, half = int(model.geom_bodyid[geom]), model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        if model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_PLANE:
            far = sum(float(np.linalg.norm(each)) for each in (model.geom_pos[geom], centre, half))
            reach[body] = max(reach[body], far)
    for body in range(model.nbody - 1, 0, -1):  # children come after their parents
        far = float(np.linalg.norm(model.body_pos[body])) + _own_way(model, body) + reach[body]
        parent = int(model.body_parentid[body])
        reach[parent] = max(reach[parent], far)
    return reach


def _own_way(model: Any, body: int) -> float:
    """Return how far the own joints of a body can move its frame from where its parent has it, in m; not a free one."""
    way, first = 0.0, int(model.body_jntadr[body])
    for joint in range(first, first + int(model.body_jntnum[body])):
        if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_SLIDE:
            way += _longest_way(model, joint)
        elif model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE:
            way += 2.0 * float(np.linalg.norm(model.jnt_pos[joint]))
    return way


def _longest_way(model: Any, joint: int) -> float:
    """Return how far a slide is believed to move from its rest position at most, in m."""
    rest = model.qpos0[model.jnt_qposadr[joint]]
    longest = float(np.abs(model.jnt_range[joint] - rest).max()) if model.jnt_limited[joint] else 0.0
    return longest + BEYOND_RANGE_M
