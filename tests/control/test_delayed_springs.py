"""Springs and dampers whose forces act late come to rest, if they are limited as the law limits them."""

from __future__ import annotations

import numpy as np
import pytest

from skillc_runtime.control.laws.impedance import DELAYED_DECAY, DELAYED_SHARE, DELAYED_SPRING

STEPS = 50
"""Steps of the simulation in a delay."""


def swing(decay: float, spring: float) -> float:
    """Return how far a body of 1 kg still swings after 200 delays, of 1 m at first.

    decay: D d / m, spring: K d^2 / m; the time is counted in delays.
    """
    h, x, v, waiting = 1.0 / STEPS, 1.0, 0.0, [0.0] * STEPS
    farthest = 0.0
    for step in range(200 * STEPS):
        waiting.append(-spring * x - decay * v)
        v += h * waiting.pop(0)
        x += h * v
        farthest = max(farthest, abs(x)) if step > 190 * STEPS else 0.0
    return farthest


@pytest.mark.parametrize("seed", range(10))
def test_a_spring_within_the_limits_comes_to_rest(seed: int) -> None:
    rng = np.random.default_rng(seed)
    decay = rng.uniform(0.1, DELAYED_DECAY)
    spring = rng.uniform(0.5, 1.0) * min(DELAYED_SHARE * decay, DELAYED_SPRING)
    assert swing(decay, spring) < 0.3


def test_stiffer_ones_do_not() -> None:
    assert swing(DELAYED_DECAY, 0.5) > 1.0
    assert swing(0.1, 0.11) > 1.0
