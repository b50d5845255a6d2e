"""Inverse kinematics of an arm with the tool that it holds."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.laws.virtual_arm import VirtualArm
from skillc_runtime.control.limits import range_margin
from skillc_runtime.kinematics.inverse import find_posture, rank_postures
from skillc_runtime.motion.pose import Array, Pose


def solve_inverse_kinematics(arm: VirtualArm, target: Pose, seed: Array, limits: Array) -> Array | None:
    """Return joints (nv,) in rad, within limits, with the tool at the target; None if there are none.

    The result is the solution from the seed if there is one, else the one nearest to it from seeds all over the range.
    Joints keep away from the ends of their ranges, where they are pushed back.
    target: pose of the tool in the frame of the base.
    seed: (nv,) in rad.
    limits: (nv, 2) in rad, the ranges of the joints.
    """
    if not arm.may_reach(target):
        return None
    return find_posture(arm.read_chain(), target, _free_range(limits), seed)


def rank_arm_postures(arm: VirtualArm, target: Pose, rest: Array, limits: Array) -> Array:
    """Return postures (n, nv) in rad, within limits, with the tool at the target, the best first.

    The first one is the one of `solve_inverse_kinematics` from `rest`.
    target: pose of the tool in the frame of the base.
    rest: (nv,) in rad.
    limits: (nv, 2) in rad, the ranges of the joints.
    """
    if not arm.may_reach(target):
        return np.empty((0, len(rest)))
    return rank_postures(arm.read_chain(), target, _free_range(limits), rest)


def _free_range(limits: Array) -> Array:
    """Return the ranges (nv, 2) in which no joint is pushed back."""
    margin = range_margin(limits)
    return np.stack([limits[:, 0] + margin, limits[:, 1] - margin], axis=1)
