"""Moves a simulated mobile base along one leg of its way, step by step, as long as nothing else has to be done."""

from __future__ import annotations

from math import cos, sin

import msgspec

from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.paths.profile import trapezoid_at

STEPS_PER_CHECK, STEPS_PER_LOOK = 5, 10
"""Number of steps between looks at the bumper, if it may touch something, and at what stands on the base."""

TIME, STEPS, TURN, DURATION, FREE, PROFILE = range(6)
"""Entries of `DrivenLeg.leg`: s since the leg began; steps of the drive; the sign of a rotation about the vertical, 0
for a straight leg; its duration in s; from which part of its way on, in m or rad, the bumper may touch something; from
here on the length, speed, accelerations and rate of a `Profile`."""

SIZE = PROFILE + 5


class DrivenLeg(msgspec.Struct, frozen=True):
    """A leg of a drive, in the world.

    leg (SIZE,): see above. start (3,): m; turned (4,): the orientation at its start; along (3,): unit vector of a
    straight leg. position (3,), quaternion (4,): where the base is, in the data of MuJoCo. step_s: of the simulation.
    """

    leg: OutVector
    start: Vector
    turned: Vector
    along: Vector
    position: OutVector
    quaternion: OutVector
    step_s: float


@compiled
def drive(driven: DrivenLeg, now: float) -> int:
    """Move by one step and return 0; or 1, and do nothing, if there is something to be looked at or the leg ends."""
    leg, position = driven.leg, driven.position
    time, steps = leg[TIME] + driven.step_s, leg[STEPS] + 1.0
    if time >= leg[DURATION] or int(steps) % STEPS_PER_LOOK == 0:
        return 1
    way = trapezoid_at(leg[PROFILE], leg[PROFILE + 1], leg[PROFILE + 2], leg[PROFILE + 3], leg[PROFILE + 4], time)[0]
    if way >= leg[FREE] and int(steps) % STEPS_PER_CHECK == 0:
        return 1
    leg[TIME], leg[STEPS] = time, steps
    if leg[TURN] == 0.0:
        for k in range(3):
            position[k] = driven.start[k] + way * driven.along[k]
        return 0
    c, s, q, out = cos(way / 2), leg[TURN] * sin(way / 2), driven.turned, driven.quaternion
    out[0], out[1], out[2], out[3] = c * q[0] - s * q[3], c * q[1] - s * q[2], c * q[2] + s * q[1], c * q[3] + s * q[0]
    if out[0] < 0.0:
        for k in range(4):
            out[k] = -out[k]
    return 0
