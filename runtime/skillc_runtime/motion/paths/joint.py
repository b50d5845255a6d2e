"""Straight lines in joint space: all joints start and stop together, and none exceeds its limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import msgspec
import numpy as np

from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.paths.profile import Profile, trapezoid_at, trapezoidal_profile
from skillc_runtime.motion.pose import Array

STARTS_AT, PROFILE, JOINTS = 0, 1, 6
"""Columns of a table of segments: s; the five numbers of a profile; then start and change (nv,) of the joints, rad."""


class JointReference(msgspec.Struct, frozen=True):
    """The reference of the joints at one instant: q, dq, ddq (nv,) in rad, rad/s, rad/s^2."""

    q: Array
    dq: Array
    ddq: Array


class JointTrajectory(Protocol):
    """A motion of the joints from rest to rest, as a pure function of time."""

    @property
    def start(self) -> Array:
        """The joint positions (nv,) in rad at the start."""
        ...

    @property
    def end(self) -> Array:
        """The joint positions (nv,) in rad at the end."""
        ...

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        ...

    @property
    def table(self) -> Array:
        """Its segments (n, m), in s, rad, rad/s and rad/s^2; see `segments_of`."""
        ...

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start.

        It rests at the start before that, and at the end afterwards.
        """
        ...


class JointMotion(msgspec.Struct, frozen=True):
    """A motion from `start` by `change`, both joint positions (nv,) in rad; the profile goes from 0 to 1."""

    start: Array
    change: Array
    profile: Profile

    @property
    def end(self) -> Array:
        """The joint positions (nv,) in rad at the end."""
        return self.start + self.change

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        return self.profile.duration

    @property
    def table(self) -> Array:
        """Its only segment, as in `segments_of`."""
        return segments_of((self,), (0.0,), self.start.size)

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start."""
        way, dq, ddq = np.multiply.outer(self.profile.at(time), self.change)
        return JointReference(self.start + way, dq, ddq)


def joint_motion(start: Array, goal: Array, speed: Array, acceleration: Array) -> JointMotion:
    """Return the fastest synchronised motion between joint positions.

    start: (nv,) in rad.
    goal: (nv,) in rad.
    speed: (nv,) in rad/s, limits above 0.
    acceleration: (nv,) in rad/s^2, limits above 0.
    """
    change = goal - start
    if np.abs(change).max() < 1e-9:
        return JointMotion(start.copy(), change, Profile(0.0, 0.0, 1.0, 1.0))
    distance = np.maximum(np.abs(change), 1e-12)
    profile = trapezoidal_profile(1.0, float((speed / distance).min()), float((acceleration / distance).min()))
    return JointMotion(start.copy(), change, profile)


def segments_of(pieces: Sequence[JointMotion], starts: Sequence[float], joints: int) -> Array:
    """Return the table (n, m), m = 6 + 2 nv, of segments of nv joints; see `STARTS_AT`.

    starts: when each begins, in s.
    """
    table = np.empty((len(pieces), JOINTS + 2 * joints))
    for row, piece, start in zip(table, pieces, starts, strict=True):
        profile = piece.profile
        numbers = profile.length, profile.peak, profile.acceleration, profile.deceleration, profile.rate
        row[STARTS_AT], row[PROFILE:JOINTS] = start, numbers
        row[JOINTS : JOINTS + joints], row[JOINTS + joints :] = piece.start, piece.change
    return table


@inlined
def joints_at(rows: Array, table: Array, time: float) -> None:
    """Compute q, dq, ddq of joints from a table.

    As `JointPath.at`: the segment that started last, and the end of the one before it.
    rows: (3, nv) in rad, rad/s, rad/s^2; it is written.
    table: (n, m) in rad and s, see `segments_of`.
    time: s, after the first segment starts.
    """
    joints, last = rows.shape[1], 0
    while last + 1 < table.shape[0] and table[last + 1, STARTS_AT] <= time:
        last += 1
    way, speed, change = _profile_at(table[last], time)
    for j in range(joints):
        whole = table[last, JOINTS + joints + j]
        rows[0, j], rows[1, j], rows[2, j] = table[last, JOINTS + j] + way * whole, speed * whole, change * whole
    if last > 0:
        way, speed, change = _profile_at(table[last - 1], time)
        for j in range(joints):
            first, whole = table[last - 1, JOINTS + j], table[last - 1, JOINTS + joints + j]
            rows[0, j] += (first + way * whole) - (first + whole)
            rows[1, j] += speed * whole
            rows[2, j] += change * whole


@inlined
def _profile_at(segment: Array, time: float) -> tuple[float, float, float]:
    """Return share, and its first and second derivative by time, of a row of a table."""
    p = segment[PROFILE:JOINTS]
    return trapezoid_at(p[0], p[1], p[2], p[3], p[4], time - segment[STARTS_AT])
