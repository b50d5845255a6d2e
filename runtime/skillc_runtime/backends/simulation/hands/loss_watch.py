"""Tells in each step whether what a hand holds may be lost, on memory that machine code shares."""

from __future__ import annotations

import msgspec

from skillc_runtime.backends.simulation.hands.finger_sensor import LAST, Opening, measure
from skillc_runtime.devices.gripper import CLOSED_FURTHER_M
from skillc_runtime.motion.arrays import Vector
from skillc_runtime.motion.numerics.compiled import compiled

COUNTS, HELD_AT = 0, 1
"""Entries of `LossWatch.held`: 1 while something counts as held; the measured opening in m when it began to."""


class LossWatch(msgspec.Struct, frozen=True):
    """What tells of a loss: `sensor`; opening (1,): the true one in m; held (2,): see above.

    step_s: how much later than at the beginning of a step the opening is measured.
    """

    sensor: Opening
    opening: Vector
    held: Vector
    step_s: float


@compiled
def may_be_lost(watch: LossWatch, now: float) -> int:
    """Return 1 if what counts as held may be lost, or Python has to measure; `has_closed_further` tells."""
    if watch.held[COUNTS] == 0.0:
        return 0
    if not measure(watch.sensor, now + watch.step_s, watch.opening[0]):
        return 1
    held_at = watch.held[HELD_AT]
    return 1 if watch.sensor.values[LAST] < held_at - min(CLOSED_FURTHER_M, held_at / 2) else 0
