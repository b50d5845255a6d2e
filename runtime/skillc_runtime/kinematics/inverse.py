"""Inverse kinematics: all postures in which the tool is at a pose, found by damped least squares from spread seeds."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np

from skillc_runtime.kinematics.chain import Chain, differentiate, pack, place
from skillc_runtime.motion.arrays import Matrix, OutMatrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, rotation_between
from skillc_runtime.motion.pose import Array, Pose

SEEDS = 64
"""From how many postures all over the ranges others are searched for."""

STEPS, LONGEST_STEP = 80, 0.3
"""Steps of one descent at most, and how far a joint moves in one, in rad or m."""

CLOSE = 1e-5
"""With a smaller error, in m and rad, the tool is at its pose."""

DAMPING, LEAST_DAMPING = 1e-2, 1e-9
"""The square of the damping: a share of the squared error, and the least."""

STALLED_AFTER, STALLED = 12, 0.97
"""A descent ends whose error is still more than this share of what it was so many steps before."""

APART_RAD = 0.2
"""Postures count as different if a joint differs by more."""

ROOM_RAD = 0.3
"""A joint that is nearer to the end of its range has little room."""

PULL = 0.05
"""Share of the distance to a posture of rest that a redundant arm moves in each step, without moving the tool."""


def find_postures(chain: Chain, target: Pose, limits: Array, rest: Array, seeds: int = SEEDS) -> Array:
    """Return postures (n, nv) in rad or m, within limits, with the tool at the target.

    Those are found that are nearest to `rest` on each branch, that nearest to it first; of a redundant arm also others,
    from seeds all over the ranges. The same in each call.
    target: pose of the tool in base.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m.
    """
    found = np.empty((seeds + 1, chain.joints))
    starts = np.concatenate([rest[None], spread_seeds(chain.slides, limits, rest, seeds)])
    count = search_postures(chain, pack(target), starts, limits, rest, found)
    return nearest_first(found[:count], rest)


def find_posture(chain: Chain, target: Pose, limits: Array, rest: Array, seeds: int = SEEDS) -> Array | None:
    """Return joints (nv,) with the tool at the target, found from `rest` if possible, else nearest to it; None if none.

    target: pose of the tool in base.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m.
    """
    direct = find_postures(chain, target, limits, rest, 0)
    found = direct if len(direct) or not seeds else find_postures(chain, target, limits, rest, seeds)
    return np.asarray(found[0]) if len(found) else None


def rank_postures(chain: Chain, target: Pose, limits: Array, rest: Array) -> Array:
    """Return postures (n, nv) with the tool at the target in the order in which they are to be tried.

    First the one that is found from `rest` or nearest to it, then those with room to the ends of the ranges, then the
    others, since a line from there may leave the range.
    target: pose of the tool in base.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m.
    """
    first = find_posture(chain, target, limits, rest, seeds=0)
    found = find_postures(chain, target, limits, rest)
    if first is None:
        first, found = (found[0], found[1:]) if len(found) else (None, found)
    if first is None:
        return found
    others = found[np.abs(found - first).max(axis=1) > APART_RAD]
    room = np.minimum(others - limits[:, 0], limits[:, 1] - others).min(axis=1)
    return np.concatenate([first[None], others[room >= ROOM_RAD], others[room < ROOM_RAD]])


def spread_seeds(slides: Array, limits: Array, rest: Array, count: int) -> Array:
    """Return postures (count, nv) all over the ranges, at most half a turn from `rest`.

    Points of the additive recurrence with the generalised golden ratio (M. Roberts 2018), which leave no gaps.
    slides: (nv,), 1 for a joint that slides, else 0; no unit.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m.
    """
    n = len(rest)
    turns = np.where(slides > 0.5, np.inf, pi)
    low, high = np.maximum(limits[:, 0], rest - turns), np.minimum(limits[:, 1], rest + turns)
    ratio = 1.5
    for _ in range(30):
        ratio = (1.0 + ratio) ** (1.0 / (n + 1))
    shares = (0.5 + np.outer(np.arange(1, count + 1), ratio ** -np.arange(1.0, n + 1.0))) % 1.0
    return np.asarray(low + shares * (high - low))


def nearest_first(postures: Array, rest: Array) -> Array:
    """Return postures (n, nv) in rad or m in the order of their greatest difference from `rest` (nv,)."""
    order = np.argsort(np.abs(postures - rest).max(axis=1), kind="stable")
    return np.asarray(postures[order])


@compiled
def search_postures(
    chain: Chain, target: Vector, starts: Matrix, limits: Matrix, rest: Vector, found: OutMatrix
) -> int:
    """Write the postures that descents from starts reach; return how many differ.

    target: (12,) in m, the pose of the tool in base.
    starts: (k, nv) in rad or m.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m, where a redundant arm is pulled, and the turn.
    found: (m, nv) in rad or m; it is written.
    """
    n, count = chain.slides.size, 0
    q = np.empty(n)
    for s in range(starts.shape[0]):
        for i in range(n):
            q[i] = starts[s, i]
        if not descend(chain.frames, chain.slides, chain.tool, target, limits, rest, q):
            continue
        unwind(chain.slides, limits, rest, q)
        new = True
        for k in range(count):
            most = 0.0
            for i in range(n):
                most = max(most, abs(found[k, i] - q[i]))
            if most < APART_RAD:
                new = False
        if new:
            for i in range(n):
                found[count, i] = q[i]
            count += 1
            if count == found.shape[0]:
                return count
    return count


@inlined
def descend(frames: Array, slides: Array, tool: Array, target: Array, limits: Array, rest: Array, q: Array) -> bool:
    """Move the joints by damped least squares within limits until the tool is at the target; return whether it is.

    dq = J^T (J J^T + lam^2 I)^-1 (e - J p) + p with p the pull to rest, if the arm is redundant. Joints at the end of
    their range that would leave it do not take part.
    frames: (nv, 12) in m, of each joint in the one before it.
    slides: (nv,), 1 for a joint that slides, else 0; no unit.
    tool: (12,) in m, its pose in the last joint.
    target: (12,) in m, its pose in base.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m.
    q: (nv,) in rad or m, where it starts; it is changed.
    """
    n = slides.size
    at, J, held = np.empty((n + 1, 12)), np.empty((6, n)), np.zeros(n)
    error, pull, step = np.empty(6), np.zeros(n), np.empty(n)
    gram, here, there = np.empty((6, 6)), np.empty((3, 3)), np.empty((3, 3))
    sides = np.empty((2, 6))
    history = np.empty(STEPS)
    for r in range(3):
        for c in range(3):
            there[r, c] = target[3 + 3 * r + c]
    for i in range(n):
        q[i] = min(max(q[i], limits[i, 0]), limits[i, 1])
    for round_ in range(STEPS):
        place(frames, slides, tool, q, at)
        size = find_error(at, target, here, there, error)
        if size < CLOSE * CLOSE:
            return True
        history[round_] = size
        if round_ >= STALLED_AFTER and sqrt(size) > STALLED * sqrt(history[round_ - STALLED_AFTER]):
            return False
        differentiate(slides, at, J)
        for i in range(n):
            held[i] = 0.0
            pull[i] = PULL * (rest[i] - q[i]) if n > 6 else 0.0
        for _ in range(3):
            damped_step(J, error, pull, held, LEAST_DAMPING + DAMPING * size, gram, sides, step)
            if not _hold_at_ends(q, step, limits, held):
                break
        longest = LONGEST_STEP
        for i in range(n):
            longest = max(longest, abs(step[i]))
        for i in range(n):
            q[i] = min(max(q[i] + step[i] * LONGEST_STEP / longest, limits[i, 0]), limits[i, 1])
    return False


@inlined
def find_error(at: Array, target: Array, here: Array, there: Array, error: Array) -> float:
    """Compute the error of the tool, and return its square.

    at: (nv + 1, 12) in m, the poses of joints and tool in base.
    target: (12,) in m, where the tool should be, in base.
    here: (3, 3), the rotation (3, 3) of the tool; it is written.
    there: (3, 3), the rotation (3, 3) of the target.
    error: (6,) in m and rad, base axes; it is written.
    """
    n = at.shape[0] - 1
    for r in range(3):
        for c in range(3):
            here[r, c] = at[n, 3 + 3 * r + c]
    rotation_between(here, there, error[3:])
    size = 0.0
    for r in range(3):
        error[r] = target[r] - at[n, r]
    for r in range(6):
        size += error[r] * error[r]
    return size


@inlined
def damped_step(
    J: Array, error: Array, pull: Array, held: Array, damping: float, gram: Array, sides: Array, step: Array
) -> None:
    """step = J^T (J J^T + damping I)^-1 (error - J pull) + pull over the joints that are not held.

    J: (6, nv), [linear m; angular rad] per rad or m, base axes.
    error: (6,) in m and rad, base axes.
    pull: (nv,) in rad or m.
    held: (nv,), 1 for a joint that is held, no unit.
    damping: lam^2, in m^2 and rad^2.
    gram: (6, 6), for use inside, in m^2 and rad^2.
    sides: (2, 6), for use inside, in m and rad.
    step: (nv,) in rad or m; it is written.
    """
    n, right, left = held.size, sides[0], sides[1]
    for a in range(6):
        right[a] = error[a]
        for i in range(n):
            if held[i] < 0.5:
                right[a] -= J[a, i] * pull[i]
        for b in range(a + 1):
            total = damping if a == b else 0.0
            for i in range(n):
                if held[i] < 0.5:
                    total += J[a, i] * J[b, i]
            gram[a, b] = total
    cholesky(gram)
    cholesky_solve(gram, right, left)
    for i in range(n):
        step[i] = 0.0
        if held[i] < 0.5:
            step[i] = pull[i]
            for a in range(6):
                step[i] += J[a, i] * left[a]


@inlined
def _hold_at_ends(q: Array, step: Array, limits: Array, held: Array) -> bool:
    """Mark in held (nv,) the joints at the end of their range that would leave it; return whether any is new."""
    new = False
    for i in range(q.size):
        if held[i] < 0.5 and (
            (q[i] <= limits[i, 0] + 1e-9 and step[i] < 0.0) or (q[i] >= limits[i, 1] - 1e-9 and step[i] > 0.0)
        ):
            held[i] = 1.0
            new = True
    return new


@inlined
def unwind(slides: Array, limits: Array, rest: Array, q: Array) -> None:
    """Change joints by whole turns so that they are nearest to `rest`, within their range.

    slides: (nv,), 1 for a joint that slides, else 0; no unit.
    limits: (nv, 2) in rad or m, the ranges of the joints.
    rest: (nv,) in rad or m.
    q: (nv,) in rad or m; it is changed.
    """
    for i in range(q.size):
        if slides[i] < 0.5:
            turned = q[i] - 2 * pi * round((q[i] - rest[i]) / (2 * pi))
            if limits[i, 0] <= turned <= limits[i, 1]:
                q[i] = turned
