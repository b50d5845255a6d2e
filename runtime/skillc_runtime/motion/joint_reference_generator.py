"""The reference of the joints: a joint motion, and the rest of the one before it."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from skillc_runtime.motion.joint_plan import (
    BRAKES,
    ENDS,
    PERIODS_AHEAD,
    make_joint_plan,
    no_segments,
    sample_joint_plan,
)
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.paths.joint import JointReference, JointTrajectory
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.stopping_motion import stopping_motion
from skillc_runtime.motion.time_scaling import RAMP_S, start_time


class JointReferenceGenerator:
    """The reference of the joints of one arm.

    Times are of any clock. `plan` has it as numbers; it is replaced with the table of a motion, and what was sampled
    ahead is forgotten when the motion changes.
    q: (nv,) in rad.
    dq: (nv,) in rad/s.
    deceleration: rad/s^2, of the fastest joint in a stop.
    now: s.
    speed: above 0 to 1, the share of the speed that motions were made with.
    """

    def __init__(self, q: Array, dq: Array, deceleration: float, now: float, speed: float = 1.0) -> None:
        """Come to rest from joint positions and speeds."""
        self._deceleration, self._speed = deceleration, speed
        self.plan = make_joint_plan(q.size)
        self._sample = bind(sample_joint_plan, self.plan)
        self._restart_from(q, dq, now)

    def _restart_from(self, q: Array, dq: Array, now: float) -> None:
        speed = self._speed
        self._time = start_time(now, speed)
        self._stopping = stopping_motion(dq / speed, self._deceleration / speed**2)
        self._rest = q + self._stopping.displacement
        self._motion: JointTrajectory | None = None
        self._ends = self._stopping.duration
        self._write()

    def set_speed(self, speed: float, now: float) -> None:
        """Let motions, also the present one, have this share of the speed that they were made with."""
        self._speed = speed
        if self._time.goal > 0.0:
            self._time = self._time.towards(speed, now)
        self._write()

    def follow(self, motion: JointTrajectory, now: float) -> None:
        """Follow a motion from now on; ValueError if it does not start at `stopping_joints`."""
        far = float(np.abs(motion.start - self.stopping_joints(now)).max())
        if far > 1e-3:
            raise ValueError(f"a motion must start where the last one ends; this one starts {far:.3f} rad beside it")
        self.stop(now)
        self._motion = motion
        self._ends = max(self._ends, motion.duration)
        self._rest = motion.end
        self._write()

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
        self._time = self._time.towards(rate, now, max(RAMP_S, fastest / self._deceleration))
        self._write()

    def sample(self, now: float) -> JointReference:
        """Return the reference at `now`."""
        self._sample(now)
        return JointReference(*self.plan.sample.copy())

    def _write(self) -> None:
        """Write the plan; what was sampled ahead holds no more."""
        plan, motion = self.plan, self._motion
        plan.clock[:] = self._time.numbers
        plan.motion[ENDS], plan.motion[BRAKES] = self._ends, self._stopping.duration
        plan.velocity[:], plan.rest[:], plan.used[0] = self._stopping.velocity, self._rest, PERIODS_AHEAD
        if motion is not None or len(plan.table):
            table = no_segments(plan.rest.size) if motion is None else motion.table
            self.plan = replace(plan, table=table)
            self._sample = bind(sample_joint_plan, self.plan)
