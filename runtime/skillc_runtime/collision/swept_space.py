"""The space that an arm sweeps on its way, and whether two arms sweep the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from skillc_runtime.collision.arm_assembly import ArmAssembly
from skillc_runtime.collision.arm_parts import ArmParts
from skillc_runtime.motion.pose import Array, Pose

CUBE_M = 0.08
"""The edge of the cubes of space; those of two arms that come closer than this have a common side, edge or corner."""

POINT_M = 0.03
"""The distance of points in a part. With STEP_M, no point of a way is farther than half of CUBE_M from one of them."""

STEP_M = 0.025
"""How far a part moves at most between two looks."""


ROWS = np.array([1 << 32, 1 << 16, 1])
"""What the numbers of a cube along x, y and z, each less than 2^15, are multiplied with to get one number."""


@dataclass(frozen=True, eq=False)
class SweptSpace:
    """Where the parts of an arm are on its way, in the world.

    middles (n, 3) m, rotations (n, 3, 3), halves (n, 3) m: of the box around a part, at one look.
    """

    middles: Array
    rotations: Array
    halves: Array

    def meets(self, other: SweptSpace) -> bool:
        """Whether any part of one comes as near to one of the other as CUBE_M; perhaps also if twice as near."""
        low, high = self._corners
        near, far = other._corners
        mine = np.all((low <= far.max(axis=0) + CUBE_M) & (high >= near.min(axis=0) - CUBE_M), axis=1)
        theirs = np.all((near <= high.max(axis=0) + CUBE_M) & (far >= low.min(axis=0) - CUBE_M), axis=1)
        if not mine.any() or not theirs.any():
            return False
        return bool(np.isin(self._list_cubes(mine), _grow(other._list_cubes(theirs))).any())

    def is_near(self, points: Array, within_m: float, below_m: float) -> bool:
        """Whether the box around any part comes nearer to a place on the floor than `within_m`, below a height.

        points: (n, 2), the places in m in the world.
        below_m: the height in the world.
        """
        low, high = (each[self._corners[0][:, 2] < below_m, :2] for each in self._corners)
        gaps = np.maximum(np.maximum(low[:, None] - points, points - high[:, None]), 0.0)
        return bool((np.linalg.norm(gaps, axis=2) < within_m).any())

    @cached_property
    def _corners(self) -> tuple[Array, Array]:
        """The lowest and the highest corners (n, 3) in m of the parts."""
        reach = np.einsum("nij,nj->ni", np.abs(self.rotations), self.halves)
        return self.middles - reach, self.middles + reach

    def _list_cubes(self, chosen: Array) -> Array:
        """Return the numbers (m,) of the cubes in which points of the chosen parts (n,) are."""
        found = list[Array]()
        for half in np.unique(self.halves[chosen], axis=0):
            same = chosen & np.all(self.halves == half, axis=1)
            places = self.middles[same][:, None] + np.einsum("nij,pj->npi", self.rotations[same], _spread(half))
            found.append(np.unique(np.floor(places / CUBE_M).astype(int) @ ROWS))
        return np.unique(np.concatenate(found))


def sweep_space(assembly: ArmAssembly, base: Pose, way: Sequence[Array]) -> SweptSpace:
    """Return the space that an arm sweeps from posture to posture of `way`, each (nv,) in rad.

    base: pose of its base in the world.
    """
    parts = ArmParts(assembly)
    looks = [parts.place(way[0])]
    for one, other in pairwise(way):
        pieces = max(1, int(np.ceil(np.abs(other - one) @ parts.levers / STEP_M)))
        looks += [parts.place(one + (other - one) * (index / pieces)) for index in range(1, pieces + 1)]
    middles, rotations = (np.concatenate(each) for each in zip(*looks, strict=True))
    return SweptSpace(
        middles=base.position + middles @ base.rotation.T,
        rotations=base.rotation @ rotations,
        halves=np.tile(parts.halves, (len(looks), 1)),
    )


def join_spaces(spaces: Sequence[SweptSpace]) -> SweptSpace:
    """Return the space that all ways together sweep."""
    return SweptSpace(
        np.concatenate([each.middles for each in spaces]),
        np.concatenate([each.rotations for each in spaces]),
        np.concatenate([each.halves for each in spaces]),
    )


def _spread(half: Array) -> Array:
    """Return points (n, 3) in m all over a box with half this size (3,), at most POINT_M apart."""
    counts = np.maximum(2, np.ceil(2 * half / POINT_M).astype(int) + 1)
    axes = [np.linspace(-size, size, count) for size, count in zip(half, counts, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def _grow(cubes: Array) -> Array:
    """Return the numbers of cubes and of all that touch one of them."""
    near = np.stack(np.meshgrid(*[(-1, 0, 1)] * 3), axis=-1).reshape(-1, 3) @ ROWS
    return np.unique(cubes[:, None] + near)
