"""Plans collision-free joint paths from one posture to another: straight if possible, else around obstacles.

Between two checked postures no point of the arm moves farther than its clearance, so it keeps at least half of it:
sum_j |dq_j| r_j <= clearance, r_j (nv,) m the longest lever of joint j.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice, pairwise

import numpy as np

from skillc_runtime.collision.collision_checker import Collision, CollisionChecker
from skillc_runtime.collision.rrt_connect import SamplerMissing, sample_path
from skillc_runtime.motion.joint import JointTrajectory
from skillc_runtime.motion.pose import Array

MIN_STEP_M = 0.01
"""Motion of the arm between two checks if its clearance is smaller."""

AROUND_RAD = 1.6
"""How far beyond start and goal joints may move on a path around obstacles."""

SEEDS = (1, 2, 3)
MAX_CHECKS = 20_000
"""Seeds of the searches for a path, of which the shortest is used, and the greatest number of checks of each."""

DRAWN, ENOUGH = 400, 4
"""Number of random postures through which a path is tried, and number of paths found that is enough."""

MAX_SEARCHES = 2
"""Number of goals for which a path around obstacles is searched."""

SAMPLE_S = 0.005
"""Time between samples of a motion."""


class NoPath(ValueError):
    """There is no collision-free path to a posture; the message says what is in the way."""


@dataclass(frozen=True, slots=True)
class JointSpace:
    """The joint space of an arm: the range (nv, 2) of its joints and safe postures (nv,), in rad."""

    range: Array
    safe: tuple[Array, ...]


def plan_joint_path(
    contacts: CollisionChecker, start: Array, goals: Iterable[Array], space: JointSpace
) -> tuple[Array, ...]:
    """Return the postures (nv,) of a path, without the start, to the first goal that can be reached.

    `contacts` then allows the distances at start and goal. Raises NoPath, which says what is in the way to the first
    goal.
    """
    reasons, searched = list[str](), 0
    for goal in goals:
        contacts.allow(start, goal)
        if (touch := contacts.find_collision(goal)) is not None:
            reasons.append(f"where it shall go {touch}")
            continue
        if find_path_collision(contacts, (start, goal)) is None:
            return (goal,)
        found, missing = _around(contacts, start, goal, space)
        if found:
            return tuple(min(found, key=lambda postures: _length(contacts, postures))[1:])
        reasons.append(f"on the straight way {contacts.worst_collision(interpolate(contacts, start, goal))}; {missing}")
        searched += 1
        if searched == MAX_SEARCHES:
            break
    raise NoPath(reasons[0])


def find_motion_collision(contacts: CollisionChecker, motion: JointTrajectory) -> Collision | None:
    """Return the first collision of a motion, which may be blended, None if there is none."""
    step, before = _step(contacts), motion.start

    def samples() -> Iterator[Array]:
        nonlocal before
        for time in np.arange(0.0, motion.duration, SAMPLE_S).tolist():
            q = motion.at(time).q
            if np.abs(q - before) @ contacts.model.levers > step / 2:
                before = q
                yield q

    return contacts.first_collision(samples())


def find_path_collision(contacts: CollisionChecker, postures: Sequence[Array]) -> Collision | None:
    """Return the first collision on the straight segments between postures (nv,), None if there is none."""
    return contacts.first_collision(q for piece in pairwise(postures) for q in interpolate(contacts, *piece))


def interpolate(contacts: CollisionChecker, start: Array, goal: Array) -> Iterator[Array]:
    """Yield postures (nv,) from a start to a goal, at distances of at most the arm's clearance."""
    change = goal - start
    pieces = max(1, int(np.ceil(np.abs(change) @ contacts.model.levers / _step(contacts))))
    yield from (start + change * (index / pieces) for index in range(1, pieces + 1))


def _around(contacts: CollisionChecker, start: Array, goal: Array, space: JointSpace) -> tuple[list[list[Array]], str]:
    """Return paths around obstacles, and the message if there are none."""
    before, missing = contacts.checks, ""
    try:
        found = _sampled_paths(contacts, start, goal, space.range)
    except SamplerMissing:
        found, missing = [], "; the extra `motion` searches longer"
    found = found or _through(contacts, start, goal, space.safe)
    found = found or _through(contacts, start, goal, _random_postures(start, goal, space.range))
    return found, f"no way around was found in {contacts.checks - before} looks{missing}"


def _through(contacts: CollisionChecker, start: Array, goal: Array, postures: Iterable[Array]) -> list[list[Array]]:
    """Return the first collision-free paths through one of the postures."""
    ways = ([start, over, goal] for over in postures)
    return list(islice((way for way in ways if find_path_collision(contacts, way) is None), ENOUGH))


def _random_postures(start: Array, goal: Array, limits: Array) -> Iterator[Array]:
    """Yield random postures around start and goal, the same in each call, at first near the straight line."""
    draw, (low, high) = np.random.default_rng(0), _bounds(start, goal, limits)
    for share in np.linspace(0.1, 1.0, DRAWN).tolist():
        between = start + (goal - start) * draw.uniform()
        yield between + share * (draw.uniform(low, high) - between)


def _bounds(start: Array, goal: Array, limits: Array) -> tuple[Array, Array]:
    """Return the bounds (nv,) of joints on a path: beyond start and goal, but within their range."""
    low, high = np.minimum(start, goal), np.maximum(start, goal)
    low = np.minimum(low, np.maximum(low - AROUND_RAD, limits[:, 0]))
    return low, np.maximum(high, np.minimum(high + AROUND_RAD, limits[:, 1]))


def _sampled_paths(contacts: CollisionChecker, start: Array, goal: Array, limits: Array) -> list[list[Array]]:
    """Return paths by sampling, with joints scaled to m by their longest levers."""
    levers = contacts.model.levers
    bounds = np.column_stack(_bounds(start, goal, limits)) * levers[:, None]
    step = _step(contacts) / np.sqrt(len(levers))

    def free(point: Array) -> bool:
        return contacts.find_collision(point / levers) is None

    ways = [sample_path(free, start * levers, goal * levers, bounds, step, MAX_CHECKS, seed) for seed in SEEDS]
    found = [[start, *(x / levers for x in way[1:-1]), goal] for way in ways if way is not None]
    return [way for way in found if find_path_collision(contacts, way) is None]


def _length(contacts: CollisionChecker, postures: Sequence[Array]) -> float:
    """Return the length of a path in m, with joints scaled by their longest levers."""
    return sum(float(np.linalg.norm((other - one) * contacts.model.levers)) for one, other in pairwise(postures))


def _step(contacts: CollisionChecker) -> float:
    return max(contacts.model.margin, MIN_STEP_M)
