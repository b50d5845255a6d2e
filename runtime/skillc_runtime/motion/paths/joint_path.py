"""Paths through several postures without stops: straight segments in joint space that overlap in time.

q(t) = q_0 + sum s_i(t - t_i) c_i, c_i (nv,) the change of segment i, s_i from 0 to 1. Neighbours overlap by at most
min(fall_i, rise_(i+1)); both ramps are linear, so |dq_i| + |dq_(i+1)| stays within the speed limit of each joint. The
accelerations add up in an overlap, so each segment is slowed down as its sharper corner requires.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from itertools import pairwise

import msgspec
import numpy as np

from skillc_runtime.motion.paths.joint import JointMotion, JointReference, joint_motion, segments_of
from skillc_runtime.motion.pose import Array


class JointPath(msgspec.Struct, frozen=True):
    """At least one straight segment, with start times in s; at most two overlap at any time. Joints: (nv,) in rad."""

    pieces: tuple[JointMotion, ...]
    starts: tuple[float, ...]

    @property
    def start(self) -> Array:
        """The joint positions (nv,) in rad at the start."""
        return self.pieces[0].start

    @property
    def end(self) -> Array:
        """The joint positions (nv,) in rad at the end."""
        return self.pieces[-1].end

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        return self.starts[-1] + self.pieces[-1].duration

    @property
    def table(self) -> Array:
        """Its segments, as in `segments_of`."""
        return segments_of(self.pieces, self.starts, self.start.size)

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start."""
        last = max(bisect_right(self.starts, time) - 1, 0)
        now = self.pieces[last].at(time - self.starts[last])
        if last == 0:
            return now
        before = self.pieces[last - 1]
        left = before.at(time - self.starts[last - 1])
        return JointReference(now.q + (left.q - before.end), now.dq + left.dq, now.ddq + left.ddq)


def joint_path(postures: Sequence[Array], speed: Array, acceleration: Array, blends: Sequence[float]) -> JointPath:
    """Return the motion through at least two postures.

    postures: each (nv,) in rad.
    speed: (nv,) in rad/s, limits.
    acceleration: (nv,) in rad/s^2, limits.
    blends: for each intermediate posture the share, 0 to 1, of the possible overlap; the motion stops there at 0.
    """
    pieces = [joint_motion(one, other, speed, acceleration) for one, other in pairwise(postures)]
    corners = zip(pairwise(pieces), blends, strict=True)
    sharp = [_sharpness(*pair, acceleration) if blend else 1.0 for pair, blend in corners]
    slower = [max(pair) for pair in pairwise((1.0, *sharp, 1.0))]
    limited = [
        piece if by == 1.0 else joint_motion(piece.start, piece.end, speed, acceleration / by)
        for piece, by in zip(pieces, slower, strict=True)
    ]
    starts = [0.0]
    for (before, after), blend in zip(pairwise(limited), blends, strict=True):
        overlap = blend * min(before.profile.fall, after.profile.rise)
        starts.append(starts[-1] + before.duration - overlap)
    return JointPath(tuple(limited), tuple(starts))


def _sharpness(before: JointMotion, after: JointMotion, acceleration: Array) -> float:
    """Return the factor by which acceleration limits are exceeded where one segment ends and the next one begins."""
    both = after.change * after.profile.acceleration - before.change * before.profile.deceleration
    return max(1.0, float((np.abs(both) / acceleration).max()))
