"""A way through several postures without stopping at them: straight pieces in joint space that overlap in time.

q(t) = q_0 + sum s_i(t - t_i) c_i, c_i (nv,) the change of piece i, s_i from 0 to 1. Neighbours overlap by at most
min(fall_i, rise_(i+1)); as both ramps are even, |dq_i| + |dq_(i+1)| then stays within the speed of each joint. Where
they do, accelerations add up, so each piece is slowed down by what the worse of its two corners asks for.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from skillc_runtime.motion.joint import JointMotion, JointReference, joint_motion
from skillc_runtime.motion.pose import Array


@dataclass(frozen=True, slots=True)
class JointPath:
    """Straight pieces, at least one, with their start times in s; no more than two move at once."""

    pieces: tuple[JointMotion, ...]
    starts: tuple[float, ...]

    @property
    def start(self) -> Array:
        """Where it begins, (nv,) in rad."""
        return self.pieces[0].start

    @property
    def end(self) -> Array:
        """Where it ends, (nv,) in rad."""
        return self.pieces[-1].end

    @property
    def duration(self) -> float:
        """Seconds from rest to rest."""
        return self.starts[-1] + self.pieces[-1].duration

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
    """Return the motion through at least two postures (nv,) in rad, within joint speeds and accelerations (nv,).

    `blends` says for each posture on the way which share, 0 to 1, of the possible overlap is taken; it stops at 0.
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
    """Return how many times the limit a joint is accelerated while one piece brakes and the next one speeds up."""
    both = after.change * after.profile.acceleration - before.change * before.profile.deceleration
    return max(1.0, float((np.abs(both) / acceleration).max()))
