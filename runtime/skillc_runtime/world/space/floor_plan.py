"""What stands in the way of a mobile base on the floor: its footprint, and those of the things at its height."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, pi
from typing import Final

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frame_tree import FrameError, Unplaced, frame_tree_of
from skillc_runtime.world.space.frames import moves_with, placement_changes, pose
from skillc_runtime.world.space.occupants import HERE, Occupant, read_occupants
from skillc_runtime.world.state.world_state import WorldState

DEPTH_M: Final = 0.002
"""How deep a base may overlap a thing, as far as its bumper gives way."""

DIRECTIONS: Final = 64
"""The number of directions along which footprints are separated; it rounds corners by 2 mm per metre of a thing."""

NEAR_M: Final = 0.25
"""To what is nearer where a base starts or where it shall stand it need not keep away."""

OPPOSITE: Final = np.roll(np.arange(DIRECTIONS), DIRECTIONS // 2)


class FloorPlan:
    """A base, with what rides on it but for arms, and the things around it.

    Places (n, 3) are of the base in the world: x and y in m, and its heading in rad. `names` are the things (things,)
    that are as high above the floor as some part of the base. What it overlaps already where it starts is no obstacle,
    until it overlaps it more. low, high: the least and the greatest x and y (2,) in m of all things. radius_m: of the
    circle in which the base is while it turns, top_m: how high it is in the world.
    """

    def __init__(self, state: WorldState, robot: str, start: Pose) -> None:
        """Read who stands where; FrameError as for `pose`. start: pose of the base in the world."""
        state = _standing(state, robot, start)
        occupants = read_occupants(state)
        riding = [each for each in occupants if _rides(state, each, robot)]
        others = [each for each in occupants if each not in riding]
        outward = start @ pose(state, robot).inverse()
        boxes = [box for each in riding for box in each.boxes]
        corners = np.array([[outward.apply(corner) for corner in box.corners] for box in boxes]).reshape(-1, 8, 3)
        heights = np.array([[each[:, 2].min(), each[:, 2].max()] for each in corners]).reshape(-1, 2)
        angles = np.arange(DIRECTIONS) * 2.0 * pi / DIRECTIONS
        self._along = np.column_stack([np.cos(angles), np.sin(angles)])
        solids = [(other.individual, solid) for other in others for solid in other.solids]
        up = np.array([0.0, 0.0, 1.0])
        lows = np.array([-solid.reach(-up, HERE) for _, solid in solids])
        highs = np.array([solid.reach(up, HERE) for _, solid in solids])
        meets = (heights[:, :1] < highs - DEPTH_M) & (heights[:, 1:] > lows + DEPTH_M)
        near = np.flatnonzero(meets.any(axis=0))
        self.names = tuple(solids[each][0] for each in near.tolist())
        self._meets = meets[:, near]
        reach = [[solids[each][1].reach(np.array([x, y, 0.0]), HERE) for x, y in self._along] for each in near.tolist()]
        self._reach = np.array(reach).reshape(-1, DIRECTIONS)
        self._corners = np.array([[start.inverse().apply(corner)[:2] for corner in each] for each in corners])
        self.radius_m = float(np.linalg.norm(self._corners, axis=2).max(initial=0.0))
        self.top_m = float(heights[:, 1].max(initial=float(start.position[2])))
        here = place_of(start)
        self.low = -self._reach[:, [DIRECTIONS // 2, 3 * DIRECTIONS // 4]].max(axis=0, initial=-here[:2].min())
        self.high = self._reach[:, [0, DIRECTIONS // 4]].max(axis=0, initial=here[:2].max())
        at_start = self._distances(here[None])[0]
        self._limit = np.where(at_start < 0.0, at_start - DEPTH_M / 2.0, 0.0)
        self._is_near = at_start < NEAR_M
        parts = (self._reach, self._corners, self._meets, self._limit)
        self._key = (self.names, *(each.tobytes() for each in parts))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FloorPlan) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    def find_touched(self, places: Array) -> tuple[str, ...]:
        """Return what the base would touch at places (n, 3), each once, in their order."""
        _, things = np.nonzero(self._distances(places) < self._limit)
        return tuple(dict.fromkeys(self.names[each] for each in things.tolist()))

    def is_free(self, places: Array) -> bool:
        """Whether the base would touch nothing at places (n, 3)."""
        return bool((self._distances(places) >= self._limit).all())

    def keep_away(self, margin_m: float, goal: Array) -> Callable[[Array], bool]:
        """Return a function that says whether the base keeps away from things at places (n, 3), by a margin in m.

        What is near where it starts, or near its goal (3,), it only does not touch.
        """
        near = self._is_near | (self._distances(goal[None])[0] < NEAR_M)
        limit = np.where(near, self._limit, margin_m)
        return lambda places: bool((self._distances(places) >= limit).all())

    def _distances(self, places: Array) -> Array:
        """Return how far the base at places is from each thing at least (n, things), in m; below 0 where they overlap.

        The greatest gap along one of the directions (separating axes).
        """
        c, s = np.cos(places[:, 2]), np.sin(places[:, 2])
        turns = np.array([[c, -s], [s, c]]).transpose(2, 0, 1)
        own = np.einsum("nij,pcj->npci", turns, self._corners) + places[:, None, None, :2]
        farthest = (own @ self._along.T).max(axis=2)
        gaps = -self._reach[:, OPPOSITE][None, None] - farthest[:, :, None, :]
        return np.asarray(np.where(self._meets, gaps.max(axis=3), np.inf).min(axis=1, initial=np.inf))


def place_of(at: Pose) -> Array:
    """Return where a pose is on the floor (3,): x and y in m, and the direction of its x axis in rad.

    at: pose in the world.
    """
    return np.array([*at.position[:2], atan2(at.rotation[1, 0], at.rotation[0, 0])])


def _standing(state: WorldState, robot: str, start: Pose) -> WorldState:
    """Return the state, in which a base that is known to be nowhere stands where it starts."""
    try:
        frame_tree_of(state).carrier(robot)
    except Unplaced:
        return state.with_changes(placement_changes(robot, start))
    return state


def _rides(state: WorldState, occupant: Occupant, robot: str) -> bool:
    try:
        return moves_with(state, occupant.individual, robot)
    except FrameError:
        return False
