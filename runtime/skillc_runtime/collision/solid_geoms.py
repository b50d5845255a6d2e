"""Convex solids in MuJoCo models, and how deep they overlap; MuJoCo is imported by whoever calls, not before."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, assert_never

from skillc_runtime.motion.pose import quaternion_from_rotation
from skillc_runtime.world.space.occupants import near_pairs, read_occupants
from skillc_runtime.world.space.shape.solids import Solid
from skillc_runtime.world.state.world_state import WorldState

FAR_M = 1.0
"""Beyond this distance no distance is computed."""


def add_solid(spec: Any, parent: Any, name: str, solid: Solid) -> Any:
    """Add a solid to a body of a specification, in whose frame its pose is; return its geom of that name."""
    import mujoco

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


def overlap_depths(pairs: Sequence[tuple[Iterable[Solid], Iterable[Solid]]]) -> list[float]:
    """Return how deep things of convex solids in one frame overlap, in m: the deepest pair of solids; 0 if none do.

    The depth of a pair is the shortest way by which one of them has to be moved so that they are apart.
    """
    if not pairs:
        return []
    import mujoco

    def add(solids: Iterable[Solid]) -> list[int]:
        """Add solids to the model, and return their numbers in it."""
        first = len(spec.geoms)
        for each in solids:
            add_solid(spec, spec.worldbody, f"solid/{len(spec.geoms)}", each)
        return list(range(first, len(spec.geoms)))

    spec, groups = mujoco.MjSpec(), list[tuple[list[int], list[int]]]()
    for one, other in pairs:
        groups.append((add(one), add(other)))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)

    def depth(one: int, other: int) -> float:
        return -float(mujoco.mj_geomDistance(model, data, one, other, FAR_M, None))

    return [max(0.0, *(depth(one, other) for one in ones for other in others)) for ones, others in groups]


def find_overlap_m(state: WorldState, individual: str) -> float:
    """Return how deep a thing or a base lies inside any other thing, in m; 0 if it does not."""
    pairs = (pair for pair in near_pairs(read_occupants(state)) if individual in {each.individual for each in pair})
    return max(overlap_depths([(one.solids, other.solids) for one, other in pairs]), default=0.0)
