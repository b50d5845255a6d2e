"""The reference of the joints: a joint motion, and the rest of the one before it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.arrays import OutMatrix, OutVector
from skillc_runtime.motion.joint import JointReference, JointTrajectory
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.stopping_motion import stopping_motion
from skillc_runtime.motion.time_scaling import RAMP_S, start_time

PERIODS_AHEAD = 10
"""How many control periods the reference is sampled ahead."""

SAME_TIME_S = 1e-9


@dataclass(frozen=True, slots=True)
class JointAhead:
    """The references of the next control periods, which whoever uses them counts.

    times (n,): s; rows (3 n, nv): q, dq and ddq of each; used (1,): how many were used.
    """

    times: OutVector
    rows: OutMatrix
    used: OutVector


@inlined
def use_ahead(ahead: JointAhead, now: float) -> int:
    """Return the first of the rows of the reference at `now` s, and count it; -1 if it was not sampled."""
    number = int(ahead.used[0])
    if number == ahead.times.size or abs(ahead.times[number] - now) > SAME_TIME_S:
        return -1
    ahead.used[0] += 1.0
    return 3 * number


class JointReferenceGenerator:
    """The reference of the joints of one arm.

    q, dq (nv,): rad, rad/s. deceleration: of the fastest joint in a stop, rad/s^2. Times `now` in s, of any clock;
    motions have the share `speed`, above 0 to 1, of the speed that they were made with. `ahead` has what `look_ahead`
    has sampled, until the motion changes.
    """

    def __init__(self, q: Array, dq: Array, deceleration: float, now: float, speed: float = 1.0) -> None:
        """Come to rest from joint positions and speeds."""
        self._deceleration, self._speed = deceleration, speed
        self.ahead = JointAhead(
            np.zeros(PERIODS_AHEAD), np.zeros((3 * PERIODS_AHEAD, q.size)), np.full(1, float(PERIODS_AHEAD))
        )
        self._restart_from(q, dq, now)

    def look_ahead(self, now: float, period: float) -> None:
        """Sample the references of the next control periods, the first at `now`."""
        for number in range(PERIODS_AHEAD):
            time = self.ahead.times[number] = now + number * period
            sample = self.sample(time)
            self.ahead.rows[3 * number : 3 * number + 3] = sample.q, sample.dq, sample.ddq
        self.ahead.used[0] = 0.0

    def _forget_ahead(self) -> None:
        self.ahead.used[0] = PERIODS_AHEAD

    def _restart_from(self, q: Array, dq: Array, now: float) -> None:
        self._forget_ahead()
        speed = self._speed
        self._time = start_time(now, speed)
        self._stopping = stopping_motion(dq / speed, self._deceleration / speed**2)
        self._rest = _at_rest(q + self._stopping.displacement)
        self._motion: JointTrajectory | None = None
        self._ends = self._stopping.duration

    def set_speed(self, speed: float, now: float) -> None:
        """Let motions, also the present one, have this share of the speed that they were made with."""
        self._forget_ahead()
        self._speed = speed
        if self._time.goal > 0.0:
            self._time = self._time.towards(speed, now)

    def follow(self, motion: JointTrajectory, now: float) -> None:
        """Follow a motion from now on; ValueError if it does not start at `stopping_joints`."""
        far = float(np.abs(motion.start - self.stopping_joints(now)).max())
        if far > 1e-3:
            raise ValueError(f"a motion must start where the last one ends; this one starts {far:.3f} rad beside it")
        self.stop(now)
        self._motion = motion
        self._ends = max(self._ends, motion.duration)
        self._rest = _at_rest(motion.end)

    def stop(self, now: float) -> None:
        """Abandon the motion and come to rest."""
        present = self.sample(now)
        self._restart_from(present.q, present.dq, now)

    def stopping_joints(self, now: float) -> Array:
        """Return the joint positions (nv,) where the reference comes to rest if it is stopped now."""
        present = self.sample(now)
        return present.q + stopping_motion(present.dq, self._deceleration).displacement

    def done(self, now: float) -> bool:
        """Tell whether the motion has ended, and the one before it as well."""
        return self._time.at(now)[0] >= self._ends

    def at_rest(self, now: float) -> bool:
        """Tell whether the reference is at rest."""
        return self.done(now)

    def stationary(self, now: float) -> bool:
        """Tell whether the reference stands still: at the end of the motion, or paused."""
        return self._time.at(now)[1] == 0.0 or self.done(now)

    def pause(self, now: float) -> None:
        """Slow down to a standstill along the motion."""
        self._scale_time(0.0, now)

    def resume(self, now: float) -> None:
        """Continue after `pause`."""
        self._scale_time(self._speed, now)

    def _scale_time(self, rate: float, now: float) -> None:
        time, fastest = self._time.at(now)[0], 0.0
        if self._motion is not None:
            speeds = [self._motion.at(time + ahead).dq for ahead in (0.0, RAMP_S / 2, RAMP_S)]
            fastest = float(np.abs(speeds).max())
        self._forget_ahead()
        self._time = self._time.towards(rate, now, max(RAMP_S, fastest / self._deceleration))

    def sample(self, now: float) -> JointReference:
        """Return the reference at `now`."""
        time, rate, slope = self._time.at(now)
        if time >= self._ends:
            return self._rest
        motion = self._motion.at(time) if self._motion else self._rest
        if time < self._stopping.duration:
            q, dq, ddq = self._stopping.at(time)
            motion = JointReference(motion.q + q, motion.dq + dq, motion.ddq + ddq)
        if rate == 1.0:
            return motion
        return JointReference(motion.q, rate * motion.dq, rate * rate * motion.ddq + slope * motion.dq)


def _at_rest(q: Array) -> JointReference:
    return JointReference(q, np.zeros_like(q), np.zeros_like(q))
