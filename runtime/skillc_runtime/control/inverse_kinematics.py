"""Inverse kinematics by damped least squares, from several seeds that are the same in each call."""

from __future__ import annotations

from math import pi

import numpy as np

from skillc_runtime.control.limits import range_margin
from skillc_runtime.control.virtual_arm import VirtualArm
from skillc_runtime.motion.pose import Array, Pose, log

STEPS, SEEDS = 150, 16
LONGEST_STEP_RAD = 0.3
CLOSE_M, CLOSE_RAD = 1e-5, 1e-5
PULL = 0.05
"""Share of the distance to the seed that a redundant arm moves in each step, without moving the tool."""


def solve_inverse_kinematics(arm: VirtualArm, target: Pose, seed: Array, limits: Array) -> Array | None:
    """Return joints (nv,) in rad, within limits (nv, 2), with the tool at `target` in base; None if there are none.

    The result is the solution from `seed` (nv,) if there is one, else the one nearest to it from seeds all over the
    range. Joints keep away from the ends of their ranges, where they are pushed back.
    """
    if not arm.may_reach(target):
        return None
    margin = range_margin(limits)
    free = np.stack([limits[:, 0] + margin, limits[:, 1] - margin], axis=1)
    direct = descend(arm, target, seed, seed, free)
    if direct is not None:
        return direct
    draw = np.random.default_rng(0)
    low, high = np.maximum(limits[:, 0], seed - pi), np.minimum(limits[:, 1], seed + pi)
    starts = [draw.uniform(low, high) for _ in range(SEEDS)]
    found = [q for start in starts if (q := descend(arm, target, start, seed, free)) is not None]
    return min(found, key=lambda q: float(np.abs(q - seed).max()), default=None)


def descend(arm: VirtualArm, target: Pose, start: Array, seed: Array, limits: Array) -> Array | None:
    """Return joints (nv,) in rad with the tool at `target` in base, found from `start` alone, near `seed`; or None."""
    q = np.clip(start, limits[:, 0], limits[:, 1])
    for _ in range(STEPS):
        arm.update_kinematics(q)
        error = pose_error(arm.tool, target)
        if np.abs(error[:3]).max() < CLOSE_M and np.abs(error[3:]).max() < CLOSE_RAD:
            return np.where(arm.turning, _unwind(q, seed, limits), q)
        step = step_towards(arm.jacobian, error, PULL * (seed - q))
        longest = float(np.abs(step).max())
        q = np.clip(q + step * min(1.0, LONGEST_STEP_RAD / longest), limits[:, 0], limits[:, 1])
    return None


def pose_error(tool: Pose, target: Pose) -> Array:
    """Return the displacement (6,) from a tool to its target, [linear m; angular rad], both poses in the same frame."""
    return np.concatenate([target.position - tool.position, log(target.rotation @ tool.rotation.T)])


def step_towards(J: Array, error: Array, pull: Array) -> Array:
    """dq = J^T (J J^T + lam^2 I)^-1 (e - J p) + p, (nv,) in rad; lam falls with the error.

    J (6, nv); e (6,): m and rad, along the same axes; p (nv,): rad, where the posture is pulled.
    """
    damping = 1e-9 + 1e-2 * float(error @ error)
    gram = J @ J.T + damping * np.eye(6)
    if J.shape[1] == 6:
        return J.T @ np.linalg.solve(gram, error)
    return pull + J.T @ np.linalg.solve(gram, error - J @ pull)


def _unwind(q: Array, seed: Array, limits: Array) -> Array:
    """Return joints changed by whole turns so that they are nearest to the seed, within their range."""
    turned = q - 2 * pi * np.round((q - seed) / (2 * pi))
    return np.where((turned >= limits[:, 0]) & (turned <= limits[:, 1]), turned, q)
