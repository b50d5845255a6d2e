"""The plan of the reference of joints as numbers, from which it is sampled ahead without Python objects.

`JointReferenceGenerator` writes the plan whenever the motion changes.
"""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import copy_vector
from skillc_runtime.motion.paths.joint import joints_at, segments_of
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.stopping_motion import stop_at
from skillc_runtime.motion.time_scaling import scaled_time

PERIODS_AHEAD = 10
"""How many control periods the reference is sampled ahead."""

SAME_TIME_S = 1e-9

ENDS, BRAKES = 0, 1
"""Entries of `JointPlan.motion`, s of motion time: when the motion is over, and when the rest of the one before is."""


class JointPlan(msgspec.Struct, frozen=True):
    """All that the reference of some joints depends on, and the samples of the next control periods.

    clock (5,): see `TimeScaling`; motion (2,): see above; velocity (nv,): rad/s, with which the motion before came;
    rest (nv,): rad, where all ends; table (n, m): see `joint.segments_of`, without rows if there is no motion. sample
    (3, nv): q, dq and ddq, rad, rad/s, rad/s^2. times (k,): s; rows (3 k, nv): q, dq and ddq at each; used (1,): how
    many of these were used, which is counted by whoever does.
    """

    clock: OutVector
    motion: OutVector
    velocity: OutVector
    rest: OutVector
    table: Matrix
    sample: OutMatrix
    times: OutVector
    rows: OutMatrix
    used: OutVector


def make_joint_plan(joints: int) -> JointPlan:
    """Return a plan without any motion, for a number of joints."""
    ahead = np.zeros(PERIODS_AHEAD), np.zeros((3 * PERIODS_AHEAD, joints)), np.full(1, float(PERIODS_AHEAD))
    return JointPlan(
        np.zeros(5), np.zeros(2), np.zeros(joints), np.zeros(joints), no_segments(joints), np.zeros((3, joints)), *ahead
    )


def no_segments(joints: int) -> Array:
    """Return the table (n, m) of no motion, with no row, in s, rad, rad/s and rad/s^2 as that of `segments_of`."""
    return segments_of((), (), joints)


@inlined
def sample_joints(rows: OutMatrix, plan: JointPlan, now: float) -> None:
    """Compute the rows q, dq and ddq (3, nv) of the joints, rad, rad/s and rad/s^2, at `now` s.

    They are of the motion and the rest of the one before it, both as fast as their time runs.
    """
    q, dq, ddq, clock = rows[0], rows[1], rows[2], plan.clock
    time, rate, slope = scaled_time(clock[0], clock[1], clock[2], clock[3], clock[4], now)
    copy_vector(plan.rest, q)
    for j in range(q.size):
        dq[j] = ddq[j] = 0.0
    if time >= plan.motion[ENDS]:
        return
    if plan.table.shape[0] > 0:
        joints_at(rows, plan.table, time)
    if time < plan.motion[BRAKES]:
        braking = np.empty((3, q.size))
        stop_at(braking, plan.velocity, plan.motion[BRAKES], time)
        for i in range(3):
            for j in range(q.size):
                rows[i, j] += braking[i, j]
    if rate != 1.0:
        for j in range(q.size):
            velocity = dq[j]
            dq[j] = rate * velocity
            ddq[j] = rate * rate * ddq[j] + slope * velocity


@compiled
def sample_joint_plan(plan: JointPlan, now: float) -> None:
    """Compute `sample` at `now` s."""
    sample_joints(plan.sample, plan, now)


@inlined
def use_ahead(plan: JointPlan, now: float, period: float) -> int:
    """Return the first of the `rows` of the reference at `now` s, and count it.

    The next control periods, of `period` s, are sampled if it was not sampled before.
    """
    number = int(plan.used[0])
    if number == plan.times.size or abs(plan.times[number] - now) > SAME_TIME_S:
        for each in range(plan.times.size):
            plan.times[each] = now + each * period
            sample_joints(plan.rows[3 * each : 3 * each + 3], plan, plan.times[each])
        number, plan.used[0] = 0, 0.0
    plan.used[0] += 1.0
    return 3 * number
