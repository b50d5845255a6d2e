"""Follows a path of the tool with an arm's joints, as its control law does, and measures what room the joints have.

So it is known before anything moves whether lanes and circles stay within the ranges of all joints, and whether motors
bear the weight of the arm and the force of the tool all along.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, inf, sqrt

import numpy as np

from skillc_runtime.kinematics.chain import Chain, add_weight, differentiate, pack, place
from skillc_runtime.kinematics.inverse import LEAST_DAMPING, PULL, damped_step, find_error
from skillc_runtime.motion.arrays import Matrix, OutMatrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.pose import Array, Pose, log, skew

STEPS, MOST_STEPS = 3, 12
"""Steps of inverse kinematics at each pose, from the posture at the pose before; more until the tool is there."""

DAMPING = 1e-2

FAR_M, FAR_RAD = 0.003, 0.03
"""With a greater error of the tool a pose is not reached."""

MARGIN, ERROR_M, ERROR_RAD, TORQUE = range(4)
"""Columns of `Sweep.measures`."""


@dataclass(frozen=True, slots=True, eq=False)
class JointLoad:
    """What joints bear on a path: limits (nv, 2) in rad or m, effort (nv,) in N m or N, the greatest torques.

    force (3,): N, that the tool exerts, gravity (3,): m/s^2; both in the base.
    """

    limits: Matrix
    effort: Vector
    force: Vector
    gravity: Vector


@dataclass(frozen=True, slots=True, eq=False)
class Sweep:
    """The postures (n, nv) along a path, in rad or m, and measures (n, 4) at each of its poses.

    MARGIN: of the joint that is nearest to the end of its range, rad or m, below 0 outside; ERROR_M, ERROR_RAD: of the
    tool; TORQUE: share of its effort of the most loaded joint.
    """

    postures: Array
    measures: Array

    @property
    def reached(self) -> Array:
        """Which poses (n,) the tool reaches with all joints in their ranges and no torque too great."""
        m = self.measures
        near = (m[:, ERROR_M] <= FAR_M) & (m[:, ERROR_RAD] <= FAR_RAD)
        return np.asarray(near & (m[:, MARGIN] >= 0.0) & (m[:, TORQUE] <= 1.0))


def follow(chain: Chain, poses: Array, start: Array, load: JointLoad) -> Sweep:
    """Return the sweep along poses (n, 12) in m of the tool in base, from joints start (nv,) in rad at the first."""
    postures, measures = np.empty((len(poses), chain.joints)), np.empty((len(poses), 4))
    follow_poses(chain, load, poses, start, postures, measures)
    return Sweep(postures, measures)


def sample_poses(corners: Sequence[Pose], step_m: float, offsets: Array | None = None) -> Array:
    """Return poses (n, 12) on the straight lines between corners, a step apart or 0.1 rad.

    corners: poses of the tool in base.
    step_m: m.
    offsets: (m, 3) in m, added to the positions in turn, as of the points of a circle around the path.
    """
    parts = [pack(corners[0])[None]]
    for one, other in pairwise(corners):
        way, turn = other.position - one.position, log(other.rotation @ one.rotation.T)
        count = max(1, ceil(max(float(np.linalg.norm(way)) / step_m, float(np.linalg.norm(turn)) / 0.1)))
        shares = np.arange(1, count + 1) / count
        turned = _turn_by(turn, shares) @ one.rotation
        parts.append(np.column_stack([one.position + shares[:, None] * way, turned.reshape(count, 9)]))
    poses = np.concatenate(parts)
    if offsets is not None:
        poses[:, :3] += np.resize(offsets, (len(poses), 3))
    return poses


def _turn_by(turn: Array, shares: Array) -> Array:
    """Return the rotations (n, 3, 3) by shares (n,) of a turn (3,) in rad, in its frame. Rodrigues' formula."""
    angle = float(np.linalg.norm(turn))
    if angle < 1e-12:
        return np.broadcast_to(np.eye(3), (len(shares), 3, 3))
    about, angles = skew(turn / angle), shares[:, None, None] * angle
    return np.asarray(np.eye(3) + np.sin(angles) * about + (1 - np.cos(angles)) * (about @ about))


@compiled
def follow_poses(
    chain: Chain, load: JointLoad, poses: Matrix, start: Vector, postures: OutMatrix, measures: OutMatrix
) -> None:
    """Follow poses from a posture, as in `Sweep`.

    poses: (n, 12) in m, of the tool in base.
    start: (nv,) in rad or m.
    postures: (n, nv) in rad or m; it is written.
    measures: (n, 4) in rad, m and shares, see `Sweep`; it is written.
    """
    n = chain.slides.size
    at, J, held, pull = np.empty((n + 1, 12)), np.empty((6, n)), np.zeros(n), np.zeros(n)
    error, step, q, sides = np.empty(6), np.empty(n), np.empty(n), np.empty((2, 6))
    gram, here, there = np.empty((6, 6)), np.empty((3, 3)), np.empty((3, 3))
    torques = np.empty(n)
    for i in range(n):
        q[i] = start[i]
    for k in range(poses.shape[0]):
        for r in range(3):
            for c in range(3):
                there[r, c] = poses[k, 3 + 3 * r + c]
        for round_ in range(MOST_STEPS):
            place(chain.frames, chain.slides, chain.tool, q, at)
            size = find_error(at, poses[k], here, there, error)
            if round_ >= STEPS and size < FAR_M * FAR_M:
                break
            differentiate(chain.slides, at, J)
            for i in range(n):
                pull[i] = PULL * (start[i] - q[i]) if n > 6 else 0.0
            damped_step(J, error, pull, held, LEAST_DAMPING + DAMPING * size, gram, sides, step)
            for i in range(n):
                q[i] += step[i]
        place(chain.frames, chain.slides, chain.tool, q, at)
        find_error(at, poses[k], here, there, error)
        differentiate(chain.slides, at, J)
        add_weight(chain.slides, chain.masses, chain.centres, at, load.gravity, torques)
        measures[k, 0] = _margin(q, load.limits)
        measures[k, 1] = sqrt(error[0] * error[0] + error[1] * error[1] + error[2] * error[2])
        measures[k, 2] = sqrt(error[3] * error[3] + error[4] * error[4] + error[5] * error[5])
        measures[k, 3] = _torque_share(J, torques, load.force, load.effort)
        for i in range(n):
            postures[k, i] = q[i]


@inlined
def _margin(q: Array, limits: Array) -> float:
    """Return the least distance of joints q (nv,) from the ends of their ranges (nv, 2), below 0 outside."""
    margin = inf
    for i in range(q.size):
        margin = min(margin, min(q[i] - limits[i, 0], limits[i, 1] - q[i]))
    return margin


@inlined
def _torque_share(J: Array, weight: Array, force: Array, effort: Array) -> float:
    """Return the greatest share of effort (nv,) that weight (nv,), in N m, and a force (3,) in N of the tool take."""
    worst = 0.0
    for i in range(weight.size):
        torque = weight[i] + J[0, i] * force[0] + J[1, i] * force[1] + J[2, i] * force[2]
        worst = max(worst, abs(torque) / effort[i])
    return worst
