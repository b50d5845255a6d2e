"""How joints get from one posture to another without touching anything: straight, else around.

Between two postures that are looked at no point of the arm moves farther than its clearance, so it stays half of that
away from everything: sum_j |dq_j| r_j <= clearance, r_j (nv,) m the longest lever of joint j.
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

LEAST_STEP_M = 0.01
"""How far the arm moves between two looks where its clearance is smaller than this."""

AROUND_RAD = 1.6
"""How far beyond start and goal joints may go on a way around."""

SEEDS = (1, 2, 3)
MOST_LOOKS = 20_000
"""So many ways are searched for, the shortest is taken; each with so many looks at most."""

DRAWN, ENOUGH = 400, 4
"""Over so many drawn postures a way is tried; of so many found the shortest is taken."""

MOST_SEARCHES = 2
"""For so many of several goals a way is searched for."""

SAMPLE_S = 0.005
"""How closely a motion is looked at in time."""


class NoPath(ValueError):
    """There is no way to a posture that touches nothing; the message says what is in the way."""


@dataclass(frozen=True, slots=True)
class JointSpace:
    """What is known of an arm beside its shape: the range (nv, 2) rad of its joints, postures (nv,) that are safe."""

    range: Array
    safe: tuple[Array, ...]


def plan_joint_path(
    contacts: CollisionChecker, start: Array, goals: Iterable[Array], known: JointSpace
) -> tuple[Array, ...]:
    """Return postures (nv,) to go through, without the start, the last one of the goals; alone where straight is free.

    The first goal that can be reached is taken; `contacts` then allow what is near at the start and there. NoWay says
    what is in the way to the first.
    """
    reasons, searched = list[str](), 0
    for goal in goals:
        contacts.allow(start, goal)
        if (touch := contacts.find_collision(goal)) is not None:
            reasons.append(f"where it shall go {touch}")
            continue
        if find_path_collision(contacts, (start, goal)) is None:
            return (goal,)
        found, missing = _around(contacts, start, goal, known)
        if found:
            return tuple(min(found, key=lambda postures: _length(contacts, postures))[1:])
        reasons.append(f"on the straight way {contacts.worst_collision(interpolate(contacts, start, goal))}; {missing}")
        searched += 1
        if searched == MOST_SEARCHES:
            break
    raise NoPath(reasons[0])


def find_motion_collision(contacts: CollisionChecker, motion: JointTrajectory) -> Collision | None:
    """Return what is touched first by a motion, blended as it may be, None when nothing is."""
    step, before = _step(contacts), motion.start

    def looked_at() -> Iterator[Array]:
        nonlocal before
        for time in np.arange(0.0, motion.duration, SAMPLE_S).tolist():
            q = motion.at(time).q
            if np.abs(q - before) @ contacts.model.levers > step / 2:
                before = q
                yield q

    return contacts.first_collision(looked_at())


def find_path_collision(contacts: CollisionChecker, postures: Sequence[Array]) -> Collision | None:
    """Return what is touched first on the straight pieces between postures (nv,), None when nothing is."""
    return contacts.first_collision(q for piece in pairwise(postures) for q in interpolate(contacts, *piece))


def interpolate(contacts: CollisionChecker, start: Array, goal: Array) -> Iterator[Array]:
    """Yield postures (nv,) from a start to a goal, no farther from each other than the arm's clearance."""
    change = goal - start
    pieces = max(1, int(np.ceil(np.abs(change) @ contacts.model.levers / _step(contacts))))
    yield from (start + change * (index / pieces) for index in range(1, pieces + 1))


def _around(contacts: CollisionChecker, start: Array, goal: Array, known: JointSpace) -> tuple[list[list[Array]], str]:
    """Return ways around, and what to say when there are none."""
    before, missing = contacts.checks, ""
    try:
        found = _searched(contacts, start, goal, known.range)
    except SamplerMissing:
        found, missing = [], "; the extra `motion` searches longer"
    found = found or _over(contacts, start, goal, known.safe)
    found = found or _over(contacts, start, goal, _drawn(start, goal, known.range))
    return found, f"no way around was found in {contacts.checks - before} looks{missing}"


def _over(contacts: CollisionChecker, start: Array, goal: Array, postures: Iterable[Array]) -> list[list[Array]]:
    """Return the first ways that lead over one of some postures."""
    ways = ([start, over, goal] for over in postures)
    return list(islice((way for way in ways if find_path_collision(contacts, way) is None), ENOUGH))


def _drawn(start: Array, goal: Array, limits: Array) -> Iterator[Array]:
    """Yield postures around start and goal, always the same ones, at first near the straight way."""
    draw, (low, high) = np.random.default_rng(0), _bounds(start, goal, limits)
    for share in np.linspace(0.1, 1.0, DRAWN).tolist():
        between = start + (goal - start) * draw.uniform()
        yield between + share * (draw.uniform(low, high) - between)


def _bounds(start: Array, goal: Array, limits: Array) -> tuple[Array, Array]:
    """Return how far (nv,) joints may go on a way around: beyond start and goal, but not out of their range."""
    low, high = np.minimum(start, goal), np.maximum(start, goal)
    low = np.minimum(low, np.maximum(low - AROUND_RAD, limits[:, 0]))
    return low, np.maximum(high, np.minimum(high + AROUND_RAD, limits[:, 1]))


def _searched(contacts: CollisionChecker, start: Array, goal: Array, limits: Array) -> list[list[Array]]:
    """Return ways around, found with joints in metres of their longest levers, so that all weigh alike."""
    levers = contacts.model.levers
    bounds = np.column_stack(_bounds(start, goal, limits)) * levers[:, None]
    step = _step(contacts) / np.sqrt(len(levers))

    def free(point: Array) -> bool:
        return contacts.find_collision(point / levers) is None

    ways = [sample_path(free, start * levers, goal * levers, bounds, step, MOST_LOOKS, seed) for seed in SEEDS]
    found = [[start, *(x / levers for x in way[1:-1]), goal] for way in ways if way is not None]
    return [way for way in found if find_path_collision(contacts, way) is None]


def _length(contacts: CollisionChecker, postures: Sequence[Array]) -> float:
    """Return how long a way is in m of the longest levers."""
    return sum(float(np.linalg.norm((other - one) * contacts.model.levers)) for one, other in pairwise(postures))


def _step(contacts: CollisionChecker) -> float:
    return max(contacts.model.margin, LEAST_STEP_M)
