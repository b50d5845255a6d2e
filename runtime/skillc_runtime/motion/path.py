"""A path through poses: straight segments whose ends overlap in time, so that corners are cut by a bounded distance.

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

from skillc_runtime.motion.pose import Array, Pose, exp, skew
from skillc_runtime.motion.reference import Reference
from skillc_runtime.motion.segments import MotionLimits, Segment, segment


@dataclass(frozen=True, slots=True)
class Path:
    """Segments with their start times in s; `corners[i]` is the pose where segment i would start without blending."""

    corners: tuple[Pose, ...]
    segments: tuple[Segment, ...]
    starts: tuple[float, ...]

    @property
    def duration(self) -> float:
        """Seconds from start to rest."""
        return self.starts[-1] + self.segments[-1].duration if self.segments else 0.0

    def at(self, time: float) -> Reference:
        """Return the reference at `time` s, in the frame of the poses."""
        last = max(bisect_right(self.starts, time) - 1, 0)
        first = last - 1 if last > 0 and time < self.starts[last - 1] + self.segments[last - 1].duration else last
        moving = _Moving(self.corners[first])
        for i in range(first, min(last + 1, len(self.segments))):
            moving.add(self.segments[i], time - self.starts[i])
        return Reference(Pose(moving.position, moving.rotation), moving.twist, moving.acceleration)


def path(poses: Sequence[Pose], limits: MotionLimits, blend_m: float = 0.0) -> Path:
    """Return the motion through `poses`, the first being the start; corners are cut by at most `blend_m`."""
    if not poses or blend_m < 0:
        raise ValueError("a path needs a start and a blend of at least 0 m")
    corners = _without_repetition(poses)
    segments = tuple(segment(start, end, limits) for start, end in pairwise(corners))
    starts, time = [], 0.0
    for i, piece in enumerate(segments):
        starts.append(time)
        if i + 1 < len(segments):
            time += piece.duration - _overlap(piece, segments[i + 1], limits.acceleration, blend_m)
    return Path(tuple(corners), segments, tuple(starts))


def _without_repetition(poses: Sequence[Pose]) -> list[Pose]:
    """Return the poses without those that equal their predecessor, where nothing would move."""
    corners = [poses[0]]
    for pose in poses[1:]:
        moved = np.abs(pose.position - corners[-1].position).max() > 1e-9
        if moved or np.abs(pose.rotation - corners[-1].rotation).max() > 1e-9:
            corners.append(pose)
    return corners


def _overlap(before: Segment, after: Segment, acceleration: float, blend_m: float) -> float:
    """Return how many seconds `after` starts before `before` has ended."""
    turn = float(np.linalg.norm(after.direction - before.direction))
    longest = min(before.fall, after.rise)
    return min(longest, sqrt(8 * blend_m / (acceleration * turn))) if turn > 1e-9 else longest * (blend_m > 0)


class _Moving:
    """The sum of the segments that move at one instant."""

    def __init__(self, start: Pose) -> None:
        self.position: Array = start.position.copy()
        self.rotation: Array = start.rotation
        self.twist = np.zeros(6)
        self.acceleration = np.zeros(6)

    def add(self, piece: Segment, time: float) -> None:
        """Add what a segment contributes `time` s after its start."""
        place, speed, acceleration = piece.way.at(time)
        self.position += place * piece.direction
        self.twist[:3] += speed * piece.direction
        self.acceleration[:3] += acceleration * piece.direction
        if piece.turn.length > 0:
            self._turn(piece, time)

    def _turn(self, piece: Segment, time: float) -> None:
        angle, rate, change = piece.turn.at(time)
        turned = exp(angle * piece.axis)
        spin = rate * piece.axis
        self.rotation = turned @ self.rotation
        self.twist[3:] = turned @ self.twist[3:]
        self.acceleration[3:] = turned @ self.acceleration[3:] + change * piece.axis + skew(spin) @ self.twist[3:]
        self.twist[3:] += spin
