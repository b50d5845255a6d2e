"""How deep convex solids overlap; MuJoCo is imported when solids are compared, not before."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from skillc_runtime.world.space.shape.solids import Solid

FAR_M = 1.0
"""Beyond this distance no distance is computed."""


def overlap_depths(pairs: Sequence[tuple[Iterable[Solid], Iterable[Solid]]]) -> list[float]:
    """Return how deep things of convex solids in one frame overlap, in m: the deepest pair of solids; 0 if none do.

    The depth of a pair is the shortest way by which one of them has to be moved so that they are apart.
    """
    if not pairs:
        return []
    import mujoco

    from skillc_runtime.collision.solid_geoms import add_solid

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
