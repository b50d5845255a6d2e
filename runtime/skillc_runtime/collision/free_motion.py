"""How far an arm can move before it has to be looked at again, from the distances of its parts at one posture.

A pair of parts that is d apart may approach by d until the next look: if it is not closer than allowed there either, it
was never closer than half of what it must keep.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import sqrt
from typing import Any, TypeAlias

import mujoco
import numpy as np

from skillc_runtime.collision.collision_model import MOVES, CollisionModel, joints_of
from skillc_runtime.motion.arrays import Matrix, Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled, inlined
from skillc_runtime.motion.pose import Array

FindAdvance: TypeAlias = Callable[[Array, Any, Array], float]
"""Returns which share of a change of joints (nv,) needs no further look, below 0 if a pair is too close.

Arguments: m, how close each pair may be, (geoms, geoms); MuJoCo's data with the contacts at the posture; the change.
"""


@dataclass(frozen=True, slots=True, eq=False)
class PartMotions:
    """How far the parts of a collision model move at most with its joints, and what distances are known of them.

    reach (geoms, nv): m per rad or m, from each joint; 0 for a joint that does not move the part. boxes (k, 2): the
    number and the bounding radius in m of boxes that move, blocks (m, 15) the position, rotation by rows and half size
    of boxes that stand: MuJoCo does not report all such pairs that are near, so spheres around the former count.
    seen_m, step_m: up to which distance pairs are reported, and how far anything may move without a look.
    """

    reach: Matrix
    boxes: Matrix
    blocks: Matrix
    seen_m: float
    step_m: float


def read_part_motions(model: CollisionModel, step_m: float) -> PartMotions:
    """Return what is known of a model; no part moves by more than `step_m` without a look if it is near something."""
    compiled_model = model.compiled
    data = mujoco.MjData(compiled_model)
    mujoco.mj_kinematics(compiled_model, data)
    moves, box = compiled_model.geom_contype == MOVES, compiled_model.geom_type == mujoco.mjtGeom.mjGEOM_BOX
    reach = np.zeros((compiled_model.ngeom, model.joints))
    for geom in np.flatnonzero(moves).tolist():
        for joint, far in joints_of(compiled_model, geom):
            if joint < model.joints:
                reach[geom, joint] = far
    moving, standing = np.flatnonzero(moves & box), np.flatnonzero(~moves & box)
    return PartMotions(
        reach=reach,
        boxes=np.column_stack([moving, compiled_model.geom_rbound[moving]]).astype(float).reshape(-1, 2),
        blocks=np.hstack([data.geom_xpos[standing], data.geom_xmat[standing], compiled_model.geom_size[standing]]),
        seen_m=model.seen_m,
        step_m=step_m,
    )


@compiled
def _advance(parts: PartMotions, least: Matrix, pairs: Matrix, far: Vector, places: Matrix, change: Vector) -> float:
    """As `FindAdvance`; pairs (n, 2), far (n,): reported pairs of parts, and m; places (geoms, 3): m, of all parts."""
    n, fastest = change.size, 0.0
    for g in range(parts.reach.shape[0]):
        moved = 0.0
        for j in range(n):
            moved += abs(change[j]) * parts.reach[g, j]
        fastest = max(fastest, moved)
    share = parts.seen_m / max(fastest, 1e-12)
    for k in range(far.size):
        a, b = int(pairs[k, 0]), int(pairs[k, 1])
        if far[k] < least[a, b]:
            return -1.0
        moved = 0.0
        for j in range(n):
            one, other = parts.reach[a, j], parts.reach[b, j]
            if one == 0.0 or other == 0.0:
                moved += abs(change[j]) * (one + other)
        share = min(share, max(far[k], parts.step_m) / max(moved, 1e-12))
    for k in range(parts.boxes.shape[0]):
        a, moved = int(parts.boxes[k, 0]), 0.0
        for j in range(n):
            moved += abs(change[j]) * parts.reach[a, j]
        if moved * share > parts.step_m:
            apart = _distance_to_blocks(parts.blocks, places[a], parts.seen_m + parts.boxes[k, 1]) - parts.boxes[k, 1]
            share = min(share, max(apart, parts.step_m) / max(moved, 1e-12))
    return share


@inlined
def _distance_to_blocks(blocks: Array, place: Array, most: float) -> float:
    """Return the distance in m of a point (3,) from the nearest of some boxes (m, 15), at most `most`."""
    nearest = most * most
    for m in range(blocks.shape[0]):
        square = 0.0
        for axis in range(3):
            along = 0.0
            for r in range(3):
                along += blocks[m, 3 + 3 * r + axis] * (place[r] - blocks[m, r])
            outside = max(abs(along) - blocks[m, 12 + axis], 0.0)
            square += outside * outside
        nearest = min(nearest, square)
    return sqrt(nearest)


def make_find_advance(parts: PartMotions) -> FindAdvance:
    """Return the function for parts whose arrays keep their places in memory."""
    advance = bind(_advance, parts)

    def find_advance(least: Array, data: Any, change: Array) -> float:
        return advance(least, data.contact.geom.astype(float), data.contact.dist, data.geom_xpos, change)

    return find_advance
