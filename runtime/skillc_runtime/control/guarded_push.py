"""A guarded push in progress, as skills see it; `push_memory` advances it once a control period."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control import push_memory as numbers
from skillc_runtime.control.push_memory import begin_approach, write_push
from skillc_runtime.devices.guarded_push import GuardedPush, MeasuredForce
from skillc_runtime.motion.pose import Array

TOUCHING_SAMPLES = 5
"""The last samples before contact is noticed, in which the tool may have touched already."""

LEAST_SAMPLES = 10
"""Of fewer samples no mean is taken."""


class ActivePush:
    """A push in progress, implementing `PushProgress`. axis (3,): the unit vector out of the surface, in base axes.

    memory (n,): its row among the pushes of its arm, until it has ended.
    """

    def __init__(self, push: GuardedPush, axis: Array, memory: Array) -> None:
        self.push, self.axis, self._memory = push, axis, memory
        write_push(memory, push, axis)

    @property
    def pressed_s(self) -> float | None:
        """For how long the tool has been in contact, in s; None if it is not."""
        memory = self._memory
        return float(memory[numbers.LASTED]) if memory[numbers.PHASE] == numbers.PRESSING else None

    @property
    def force(self) -> MeasuredForce:
        """What was measured of its force up to now: the median before contact, the mean in contact."""
        return measured_force(self._memory)

    @property
    def action(self) -> float:
        """What the arm must do next, as in `push_memory`."""
        return float(self._memory[numbers.ACTION])

    def hold(self) -> None:
        """Neither approach nor press until `approach`."""
        self._memory[numbers.PHASE] = numbers.HELD

    def approach(self) -> None:
        """Approach after `hold`."""
        begin_approach(self._memory)

    def end(self) -> None:
        """Leave the row to another push; what was measured is kept."""
        row, self._memory = self._memory, self._memory.copy()
        row[numbers.PHASE] = numbers.NO_PUSH


def measured_force(memory: Array) -> MeasuredForce:
    """Return what was measured of the force of a push up to now; memory (n,): in N, s and m, of the push."""
    free = int(min(memory[numbers.FREE_COUNT] - TOUCHING_SAMPLES, numbers.FREE_SAMPLES))
    count = memory[numbers.COUNT]
    samples = memory[numbers.FREE : numbers.FREE + max(free, 0)].tolist()
    return MeasuredForce(
        free_n=float(np.median(samples)) if len(samples) >= LEAST_SAMPLES else None,
        pressed_n=float(memory[numbers.TOTAL] / count) if count >= LEAST_SAMPLES else None,
    )
