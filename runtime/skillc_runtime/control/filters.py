"""A first-order lag that does not depend on the control rate: x <- x + (1 - exp(-h/T)) (target - x)."""

from __future__ import annotations

from math import exp

from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined


@inlined
def lag_share(period: float, time_constant: float) -> float:
    """Return the share of the way to its target that a lag covers in a period; period, time_constant: s."""
    return 1 - exp(-period / time_constant) if time_constant > 0 else 1.0


@compiled
def step_lag(value: OutVector, target: Vector, share: float, grain: float) -> bool:
    """Let a value cover a share of the way to its target; at a distance of `grain` all of it.

    Return whether it has arrived.
    value: (n,) in any unit.
    target: (n,) in any unit, that of the value.
    share: 0 to 1, the share of the way, without a unit.
    grain: in any unit, that of the value.
    """
    square = 0.0
    for i in range(value.size):
        square += (target[i] - value[i]) * (target[i] - value[i])
    arrived = square <= grain * grain
    for i in range(value.size):
        value[i] = target[i] if arrived else value[i] + share * (target[i] - value[i])
    return arrived
