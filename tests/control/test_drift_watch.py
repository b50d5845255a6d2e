"""How fast a sensor drifts is found by its tares, and told from noise and from another posture."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.control.supervision.drift_watch import NOISE_N, SHORTEST_S, DriftWatch
from skillc_runtime.motion.pose import Array

DOWN = np.array([0.0, 0.0, -1.0])


def tare_again(watch: DriftWatch, times: list[float], drift: Array, rng: np.random.Generator, noise_n: float) -> None:
    """Tare a sensor with a steady drift (3,) in N/s at these times in s, as an arm does."""
    zero, tared_s = np.zeros(3), 0.0
    for at_s in times:
        left = drift * at_s - zero - watch.rate * (at_s - tared_s)
        felt = left + noise_n * rng.standard_normal(3)
        zero, tared_s = zero + watch.rate * (at_s - tared_s) + felt, at_s
        watch.note(felt, DOWN, at_s)


@given(st.integers(0, 10_000))
def test_a_steady_drift_is_found(seed: int) -> None:
    rng = np.random.default_rng(seed)
    drift, times = rng.uniform(-0.05, 0.05, 3), np.cumsum(rng.uniform(5.0, 20.0, 4)).tolist()
    watch = DriftWatch()
    tare_again(watch, times, drift, rng, 0.0)
    np.testing.assert_allclose(watch.rate, drift, atol=0.002)


@given(st.integers(0, 10_000))
def test_noise_is_hardly_a_drift_and_less_so_the_longer_it_is_watched(seed: int) -> None:
    rng, watch = np.random.default_rng(seed), DriftWatch()
    tare_again(watch, [0.0, 20.0, 40.0, 60.0], np.zeros(3), rng, NOISE_N)
    assert np.abs(watch.rate).max() < 5 * np.sqrt(2.0) * NOISE_N / 20.0


def test_another_posture_or_load_says_nothing_of_a_drift() -> None:
    watch = DriftWatch()
    watch.note(np.ones(3), DOWN, 0.0)
    watch.note(np.ones(3), np.array([1.0, 0.0, 0.0]), 10.0)
    assert not watch.rate.any()
    watch.forget_posture()
    watch.note(np.ones(3), np.array([1.0, 0.0, 0.0]), 20.0)
    assert not watch.rate.any()
    watch.note(np.full(3, 0.5), np.array([1.0, 0.0, 0.0]), 20.0 + SHORTEST_S / 2)
    assert not watch.rate.any(), "too soon"
    watch.note(np.full(3, 0.5), np.array([1.0, 0.0, 0.0]), 30.0)
    assert watch.rate == pytest.approx(0.05, rel=0.1)
