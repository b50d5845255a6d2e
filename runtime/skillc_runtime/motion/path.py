"""A path through poses: lines and arcs whose ends overlap in time, so that corners are cut by a bounded distance.

Overlapping displacements add up: x_d = x_0 + sum s_i(t - t0_i) u_i. Rotations compose on the left in the same order.
Two neighbours overlap by min(fall_i, rise_(i+1), sqrt(8 blend / (a |u_(i+1) - u_i|))), which keeps the corner within
`blend` and the acceleration within a |u_(i+1) - u_i|; no more than two segments ever move at once.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import sqrt

import numpy as np

from skillc_runtime.motion.arc import Arc
from skillc_runtime.motion.pose import Array, Pose, exp, skew
from skillc_runtime.motion.reference import Reference, at_rest
from skillc_runtime.motion.segments import MotionLimits, Segment, segment


@dataclass(frozen=True, slots=True)
class Path:
    """Segments with their start times in s; `corners[i]` is the pose where segment i would start without blending."""

    corners: tuple[Pose, ...]
    segments: tuple[Segment | Arc, ...]
    starts: tuple[float, ...]

    @property
    def duration(self) -> float:
        """Seconds from start to rest."""
        return self.starts[-1] + self.segments[-1].duration if self.segments else 0.0

    def at(self, time: float) -> Reference:
        """Return the reference at `time` s, in the frame of the poses."""
        if not self.segments:
            return at_rest(self.corners[0])
        last = max(bisect_right(self.starts, time) - 1, 0)
        ended = last == 0 or time >= self.starts[last - 1] + self.segments[last - 1].duration
        if ended:
            return self._moved_on(last, self.corners[last], self._motion(last, time))
        before, motion = self._motion(last - 1, time), self._motion(last, time)
        start = self._moved_on(last - 1, self.corners[last - 1], before).pose
        return self._moved_on(last, start, _composed(before, motion))

    def moved(self, frame: Pose) -> Path:
        """Return the same motion, given in `frame`, in the frame's parent."""
        corners = tuple(frame @ corner for corner in self.corners)
        return Path(corners, tuple(piece.moved(frame) for piece in self.segments), self.starts)

    def _motion(self, index: int, time: float) -> Array:
        return self.segments[index].at(time - self.starts[index])

    def _moved_on(self, index: int, start: Pose, motion: Array) -> Reference:
        """Return the reference after the way of a segment from a pose, with twist and acceleration; motion (3, 6)."""
        way, twist, acceleration = motion
        turns = self.segments[index].turn.length > 0
        rotation = exp(way[3:]) @ start.rotation if turns else start.rotation
        return Reference(Pose(start.position + way[:3], rotation), twist, acceleration)


def _composed(before: Array, motion: Array) -> Array:
    """Add to a motion (3, 6) the twist and acceleration of one that is turned by it; ways stay as they are."""
    turned, spin = exp(motion[0, 3:]), motion[1, 3:]
    velocity = turned @ before[1, 3:]
    motion[1, :3] += before[1, :3]
    motion[2, :3] += before[2, :3]
    motion[2, 3:] += turned @ before[2, 3:] + skew(spin) @ velocity
    spin += velocity
    return motion


def path(poses: Sequence[Pose], limits: MotionLimits, blend_m: float = 0.0) -> Path:
    """Return the motion through `poses`, the first being the start; corners are cut by at most `blend_m`."""
    if not poses or blend_m < 0:
        raise ValueError("a path needs a start and a blend of at least 0 m")
    corners = _without_repetition(poses)
    return joined(corners, [segment(start, end, limits) for start, end in pairwise(corners)], limits, blend_m)


def joined(
    corners: Sequence[Pose], pieces: Sequence[Segment | Arc], limits: MotionLimits, blend_m: float = 0.0
) -> Path:
    """Return lines and arcs, one from each corner to the next, as one path; corners are cut by at most `blend_m`."""
    starts, time = [], 0.0
    for i, piece in enumerate(pieces):
        starts.append(time)
        if i + 1 < len(pieces):
            time += piece.duration - _overlap(piece, pieces[i + 1], limits.acceleration, blend_m)
    return Path(tuple(corners), tuple(pieces), tuple(starts))


def _without_repetition(poses: Sequence[Pose]) -> list[Pose]:
    """Return the poses without those that equal their predecessor, where nothing would move."""
    corners = [poses[0]]
    for pose in poses[1:]:
        moved = np.abs(pose.position - corners[-1].position).max() > 1e-9
        if moved or np.abs(pose.rotation - corners[-1].rotation).max() > 1e-9:
            corners.append(pose)
    return corners


def _overlap(before: Segment | Arc, after: Segment | Arc, acceleration: float, blend_m: float) -> float:
    """Return how many seconds `after` starts before `before` has ended.

    Where one of them bends, the corner is cut by no more than half an overlap leads away from it: a (t/2)^2 / 2.
    """
    turn = float(np.linalg.norm(after.leaving - before.arriving))
    if isinstance(before, Arc) or isinstance(after, Arc):
        turn = max(turn, 1.0)
    longest = min(before.fall, after.rise)
    return min(longest, sqrt(8 * blend_m / (acceleration * turn))) if turn > 1e-9 else longest * (blend_m > 0)
