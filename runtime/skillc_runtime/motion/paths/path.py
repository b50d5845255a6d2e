"""Paths through poses: lines and arcs that overlap in time, so that corners are blended within a distance.

Overlapping displacements add up: x_d = x_0 + sum s_i(t - t0_i) u_i. Rotations compose on the left in the same order.
Two neighbours overlap by min(fall_i, rise_(i+1), sqrt(8 blend / (a |u_(i+1) - u_i|))), which keeps the corner within
`blend` and the acceleration within a |u_(i+1) - u_i|; no more than two segments ever move at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import sqrt

import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import cross, product, rotation_by, times
from skillc_runtime.motion.paths.arc import Arc
from skillc_runtime.motion.paths.segment_sampling import COLUMNS, motion_at
from skillc_runtime.motion.paths.segments import MotionLimits, Segment, segment_between
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Reference, resting_reference

START, END = COLUMNS, COLUMNS + 1
"""Columns of start and end time in s, after those of the segment itself."""

PLACE, AXES = COLUMNS + 2, COLUMNS + 5
"""Columns of the corner where the segment starts: position (3,) and rotation, row by row (9,)."""


COLUMNS_OF_PATH = AXES + 9


@dataclass(frozen=True, slots=True)
class Path:
    """Segments with start times in s; `corners[i]` is the pose, in the parent frame, where segment i starts unblended.

    table (n, 35): a row a segment, see `segment_sampling` and the columns above.
    """

    corners: tuple[Pose, ...]
    segments: tuple[Segment | Arc, ...]
    starts: tuple[float, ...]
    table: Array = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Write each segment to a row of the table."""
        rows = [
            [*piece.row, start, start + piece.duration, *corner.position, *corner.rotation.ravel()]
            for piece, start, corner in zip(self.segments, self.starts, self.corners, strict=False)
        ]
        object.__setattr__(self, "table", np.array(rows).reshape(len(rows), COLUMNS_OF_PATH))

    @property
    def tabled(self) -> tuple[Array, float]:
        """The table of the path, and by how much its motion is slowed down, for `reference_plan`."""
        return self.table, 1.0

    @property
    def duration(self) -> float:
        """The time in s from start to rest."""
        return self.starts[-1] + self.segments[-1].duration if self.segments else 0.0

    def at(self, time: float) -> Reference:
        """Return the reference at `time` s, in the frame of the corners."""
        if not self.segments:
            return resting_reference(self.corners[0])
        rows = np.empty((8, 3))
        path_at(rows, self.table, time)
        return Reference(rows)

    def transform(self, frame: Pose) -> Path:
        """Return the same motion in the parent frame of `frame`."""
        corners = tuple(frame @ corner for corner in self.corners)
        return Path(corners, tuple(piece.transform(frame) for piece in self.segments), self.starts)


@inlined
def _start_from(position: Array, rotation: Array, row: Array) -> None:
    """Start from the corner of a row."""
    for i in range(3):
        position[i] = row[PLACE + i]
        for j in range(3):
            rotation[i, j] = row[AXES + 3 * i + j]


@inlined
def _move(position: Array, rotation: Array, way: Array) -> None:
    """Displace a pose by `way` (6,), m and rad: rotation <- exp(way[3:]) rotation."""
    for i in range(3):
        position[i] += way[i]
    if way[3] != 0.0 or way[4] != 0.0 or way[5] != 0.0:
        turned, before = np.empty((3, 3)), rotation.copy()
        rotation_by(way[3:], turned)
        product(turned, before, rotation)


@inlined
def _add(motion: Array, before: Array) -> None:
    """Add to a motion (3, 6) the twist and acceleration of the one before, which it rotates; not the displacement."""
    turned, velocity, change, spun = np.empty((3, 3)), np.empty(3), np.empty(3), np.empty(3)
    rotation_by(motion[0, 3:], turned)
    times(turned, before[1, 3:], velocity)
    times(turned, before[2, 3:], change)
    cross(motion[1, 3:], velocity, spun)
    for i in range(3):
        motion[1, i] += before[1, i]
        motion[2, i] += before[2, i]
        motion[1, 3 + i] += velocity[i]
        motion[2, 3 + i] += change[i] + spun[i]


@inlined
def _started_last(table: Array, time: float) -> int:
    """Return the last row that has started by `time` s, or the first one if none has."""
    last, later = 0, table.shape[0]
    while later - last > 1:
        between = (last + later) // 2
        if table[between, START] <= time:
            last = between
        else:
            later = between
    return last


@compiled
def path_at(rows: OutMatrix, table: Matrix, time: float) -> None:
    """Compute the reference from the table of a `Path`, in the frame of its corners.

    rows: (8, 3) in m, m/s, rad/s and so on, see `Reference`; it is written.
    table: (n, m) in m, rad and s, of the path.
    time: s, after the start.
    """
    position, rotation = rows[0], rows[1:4]
    last, motion = _started_last(table, time), np.empty((3, 6))
    motion_at(motion, table[last, :COLUMNS], time - table[last, START])
    if last > 0 and time < table[last - 1, END]:
        before = np.empty((3, 6))
        motion_at(before, table[last - 1, :COLUMNS], time - table[last - 1, START])
        _start_from(position, rotation, table[last - 1])
        _move(position, rotation, before[0])
        _add(motion, before)
    else:
        _start_from(position, rotation, table[last])
    _move(position, rotation, motion[0])
    for i in range(3):
        rows[4, i], rows[5, i] = motion[1, i], motion[1, 3 + i]
        rows[6, i], rows[7, i] = motion[2, i], motion[2, 3 + i]


def path_through(poses: Sequence[Pose], limits: MotionLimits, blend_m: float = 0.0) -> Path:
    """Return the motion through poses of one frame, the first one the start; corners are blended within `blend_m`."""
    if not poses or blend_m < 0:
        raise ValueError("a path needs a start and a blend of at least 0 m")
    corners = _without_repetition(poses)
    return join_segments(
        corners, [segment_between(start, end, limits) for start, end in pairwise(corners)], limits, blend_m
    )


def join_segments(
    corners: Sequence[Pose], pieces: Sequence[Segment | Arc], limits: MotionLimits, blend_m: float = 0.0
) -> Path:
    """Return the path along segments, one from each of `corners` to the next in one frame, blended within `blend_m`."""
    starts, time = [], 0.0
    for i, piece in enumerate(pieces):
        starts.append(time)
        if i + 1 < len(pieces):
            time += piece.duration - _overlap(piece, pieces[i + 1], limits.acceleration, blend_m)
    return Path(tuple(corners), tuple(pieces), tuple(starts))


def _without_repetition(poses: Sequence[Pose]) -> list[Pose]:
    """Return the poses without those that equal their predecessor."""
    corners = [poses[0]]
    for pose in poses[1:]:
        moved = np.abs(pose.position - corners[-1].position).max() > 1e-9
        if moved or np.abs(pose.rotation - corners[-1].rotation).max() > 1e-9:
            corners.append(pose)
    return corners


def _overlap(before: Segment | Arc, after: Segment | Arc, acceleration: float, blend_m: float) -> float:
    """Return the time in s that `after` starts before `before` has ended.

    With an arc the distance to the corner is at most what half an overlap moves away from it: a (t/2)^2 / 2.
    """
    turn = float(np.linalg.norm(after.start_direction - before.end_direction))
    if isinstance(before, Arc) or isinstance(after, Arc):
        turn = max(turn, 1.0)
    longest = min(before.fall, after.rise)
    return min(longest, sqrt(8 * blend_m / (acceleration * turn))) if turn > 1e-9 else longest * (blend_m > 0)
