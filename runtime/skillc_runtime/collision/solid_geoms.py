"""Adds convex solids to a MuJoCo model under construction."""

from __future__ import annotations

from typing import Any, assert_never

import mujoco

from skillc_runtime.motion.pose import quaternion_from_rotation
from skillc_runtime.world.space.shape.solids import Solid


def add_solid(spec: Any, parent: Any, name: str, solid: Solid) -> Any:
    """Add a solid to a body of a specification, in whose frame its pose is; return its geom of that name."""
    geom = parent.add_geom(name=name)
    geom.pos, geom.quat = solid.place.position, quaternion_from_rotation(solid.place.rotation)
    x, y, z = solid.half
    match solid.kind:
        case "box":
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_BOX, [x, y, z]
        case "cylinder":
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CYLINDER, [x, z, 0.0]
        case "sphere":
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [x, 0.0, 0.0]
        case "capsule":
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CAPSULE, [x, z - x, 0.0]
        case "hull":
            points = solid.of_hull.points
            spec.add_mesh(name=name, uservert=points.ravel(), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, name
        case _:
            assert_never(solid.kind)
    return geom
