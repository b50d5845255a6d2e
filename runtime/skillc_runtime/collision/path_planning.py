"""Plans collision-free joint paths from one posture to another: straight if possible, else around obstacles.

Between two checked postures no point of the arm moves farther than it is away from anything, so that it keeps at least
half of its clearance.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import msgspec
import numpy as np

from skillc_runtime.cancellation import check_current
from skillc_runtime.collision.collision_checker import MIN_STEP_M, Collision, CollisionChecker
from skillc_runtime.collision.rrt_connect import sample_path
from skillc_runtime.motion.paths.joint import JointTrajectory
from skillc_runtime.motion.pose import Array

SEARCHES = ((1.6, 2_000), (1.0, 4_000), (1.0, 8_000), (1.6, 4_000), (3.2, 4_000))
"""How far beyond start and goal joints may move in the searches for a path, in rad, and the random postures in each."""

MAX_SEARCHES = 2
"""Number of goals for which a path around obstacles is searched for."""

SAMPLE_S = 0.005
"""Time between samples of a motion."""


class NoPath(ValueError):
    """There is no collision-free path to a posture; the message says what is in the way."""


class JointSpace(msgspec.Struct, frozen=True):
    """The joint space of an arm: the range (nv, 2) of its joints and safe postures (nv,), in rad."""

    range: Array
    safe: tuple[Array, ...]


def plan_joint_path(
    contacts: CollisionChecker, start: Array, goals: Iterable[Array], space: JointSpace
) -> tuple[Array, ...]:
    """Return the postures (nv,) of a path, without the start, to the first goal that can be reached.

    `contacts` then allows the distances at start and goal. Raises NoPath, which says what is in the way to the first
    goal. Cancelled if the work around it ends. start, each of goals (nv,): rad.
    """
    reasons, searched = list[str](), 0
    for goal in goals:
        contacts.allow(start, goal)
        if (touch := contacts.find_collision(goal)) is not None:
            reasons.append(f"where it shall go {touch}")
            continue
        if is_path_free(contacts, (start, goal)):
            return (goal,)
        before = contacts.checks
        found = _sample_path(contacts, start, goal, space.range) or _go_through(contacts, start, goal, space.safe)
        if found is not None:
            return found
        touches = filter(None, map(contacts.find_collision, interpolate(contacts, start, goal)))
        nearest = min(touches, key=lambda each: each.distance_m, default=None) or "it would come too near"
        looks = contacts.checks - before
        reasons.append(f"on the straight way {nearest}; no way around was found in {looks} looks")
        searched += 1
        if searched == MAX_SEARCHES:
            break
    raise NoPath(reasons[0])


def find_motion_collision(contacts: CollisionChecker, motion: JointTrajectory) -> Collision | None:
    """Return the first collision of a motion, which may be blended, None if there is none."""
    before = motion.start
    for time in np.arange(0.0, motion.duration, SAMPLE_S).tolist():
        q = motion.at(time).q
        if np.abs(q - before) @ contacts.model.levers > _step(contacts) / 2:
            before = q
            if (touch := contacts.find_collision(q)) is not None:
                return touch
    return None


def is_path_free(contacts: CollisionChecker, postures: Sequence[Array]) -> bool:
    """Whether the straight pieces between postures, each (nv,) in rad, are free, the first of which is."""
    return all(contacts.find_free_share(*piece) == 1.0 for piece in pairwise(postures))


def interpolate(contacts: CollisionChecker, start: Array, goal: Array) -> Iterator[Array]:
    """Yield postures (nv,) from a start to a goal, at distances of at most the arm's clearance."""
    change = goal - start
    pieces = max(1, int(np.ceil(np.abs(change) @ contacts.model.levers / _step(contacts))))
    yield from (start + change * (index / pieces) for index in range(1, pieces + 1))


def _go_through(
    contacts: CollisionChecker, start: Array, goal: Array, postures: Iterable[Array]
) -> tuple[Array, ...] | None:
    """Return the first collision-free path through one of the postures."""
    ways = ((over, goal) for over in postures)
    return next((way for way in ways if is_path_free(contacts, (start, *way))), None)


def _bounds(start: Array, goal: Array, limits: Array, more_rad: float) -> tuple[Array, Array]:
    """Return the bounds (nv,) of joints on a path: up to `more_rad` beyond start and goal, but within their range."""
    low, high = np.minimum(start, goal), np.maximum(start, goal)
    low = np.minimum(low, np.maximum(low - more_rad, limits[:, 0]))
    return low, np.maximum(high, np.minimum(high + more_rad, limits[:, 1]))


def _sample_path(contacts: CollisionChecker, start: Array, goal: Array, limits: Array) -> tuple[Array, ...] | None:
    """Return a path by sampling, with joints scaled to m by their longest levers: first near start and goal."""
    levers = contacts.model.levers

    def reach(one: Array, other: Array) -> float:
        check_current()
        return contacts.find_free_share(one / levers, other / levers)

    for seed, (more_rad, rounds) in enumerate(SEARCHES):
        bounds = np.column_stack(_bounds(start, goal, limits, more_rad)) * levers[:, None]
        way = sample_path(reach, start * levers, goal * levers, bounds, rounds, seed)
        found = () if way is None else (*(x / levers for x in way[1:-1]), goal)
        if found and is_path_free(contacts, (start, *found)):
            return found
    return None


def _step(contacts: CollisionChecker) -> float:
    return max(contacts.model.margin, MIN_STEP_M)
