"""Averages the force that an arm measures along a push: of nothing while it approaches, and while it presses.

What a sensor reads of nothing is its bias; what the torques of an arm tell then is the error of its payload.
"""

from __future__ import annotations

from collections.abc import Callable
from statistics import median

from skillc_runtime.devices.guarded_push import MeasuredForce
from skillc_runtime.motion.pose import Array

SAMPLE_S = 0.01
"""Period with which forces are sampled."""

STEADY_S, SETTLED_S = 0.1, 0.5
"""How long a tool has moved steadily, or pressed, before its force is sampled."""

TOUCHING_SAMPLES = 5
"""The last samples before contact is noticed, in which the tool may have touched already."""

LEAST_SAMPLES = 10
"""Of fewer samples no mean is taken."""

FREE_SAMPLES = 50
"""The number of samples, the first ones, of which the median before contact is taken: what yields is touched before
contact is noticed."""


class PushForceMeter:
    """Measures the force of one push along its axis (3,), a unit vector out of the surface, in base axes.

    felt: returns the wrench (6,) of the environment on the tool, N and N m, base axes; None where nothing measures it.
    """

    def __init__(self, axis: Array, felt: Callable[[], Array | None]) -> None:
        self._axis, self._felt, self._age = axis, felt, 0.0
        self._free: list[float] = []
        self._steady_s = 0.0
        self._total_n, self._count = 0.0, 0

    @property
    def mean(self) -> MeasuredForce:
        """What was measured up to now."""
        free = self._free[:-TOUCHING_SAMPLES][:FREE_SAMPLES]
        return MeasuredForce(
            free_n=median(free) if len(free) >= LEAST_SAMPLES else None,
            pressed_n=self._total_n / self._count if self._count >= LEAST_SAMPLES else None,
        )

    def approach(self, moves: bool, period: float) -> None:
        """Advance by `period` s, in which the tool has moved steadily towards the surface, or has not."""
        self._steady_s = self._steady_s + period if moves else 0.0
        if self._steady_s >= STEADY_S and self._count == 0 and (force_n := self._sample(period)) is not None:
            self._free.append(force_n)

    def press(self, lasted_s: float, period: float) -> None:
        """Advance by `period` s, in which the tool has pressed, for `lasted_s` s."""
        if lasted_s >= SETTLED_S and (force_n := self._sample(period)) is not None:
            self._total_n, self._count = self._total_n + force_n, self._count + 1

    def _sample(self, period: float) -> float | None:
        self._age += period
        if self._age < SAMPLE_S - period / 2:
            return None
        self._age, wrench = 0.0, self._felt()
        return None if wrench is None else float(self._axis @ wrench[:3])
