"""The pose on which several estimates agree: false alarms are left out, noise is averaged."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skillc_runtime.devices.camera import PoseEstimate
from skillc_runtime.motion.pose import Pose, exp, log

AGREE_M, AGREE_RAD = 0.005, 0.05
"""Estimates agree if they are this close to each other, or closer than their noise makes likely."""

DEVIATIONS = 5.0
"""Standard deviations of an estimate by which two that agree may differ."""


def agreeing_estimates(estimates: Sequence[PoseEstimate]) -> list[PoseEstimate]:
    """Return the largest group of estimates that agree with one of them."""
    groups = ([other for other in estimates if _agree(one, other)] for one in estimates)
    return max(groups, key=len, default=[])


def mean_pose(estimates: Sequence[PoseEstimate]) -> Pose:
    """Return the mean of estimates, at least one, that agree; rotations are averaged as rotation vectors.

    With R_0 the first rotation and w_i = log(R_0^T R_i), the mean is R_0 exp(mean w_i): exact to the third order of w.
    """
    first = estimates[0].pose.rotation
    turn = np.mean([log(first.T @ each.pose.rotation) for each in estimates], axis=0)
    return Pose(np.mean([each.pose.position for each in estimates], axis=0), first @ exp(turn))


def _agree(one: PoseEstimate, other: PoseEstimate) -> bool:
    away = float(np.linalg.norm(one.pose.position - other.pose.position))
    turned = float(np.linalg.norm(log(one.pose.rotation.T @ other.pose.rotation)))
    return away <= max(AGREE_M, DEVIATIONS * one.position_m) and turned <= max(AGREE_RAD, DEVIATIONS * one.angle_rad)
