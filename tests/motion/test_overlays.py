"""Overlays: derivatives by finite differences, fading, constant speed of the spiral, purity in time."""

import numpy as np
import pytest

from skillc_runtime.motion.overlays import Circle, FadedOverlay, Lissajous, Spiral

CIRCLE = Circle(radius=0.015, rate=1.0)
OVERLAYS = {
    "circle": CIRCLE,
    "sine": Lissajous(np.array([0.02, 0, 0]), np.array([2.0, 0, 0]), np.array([0.3, 0, 0])),
    "lissajous": Lissajous(np.array([0.02, 0.01, 0]), np.array([2.0, 3.0, 0]), np.zeros(3)),
    "spiral": Spiral(pitch=0.01, speed=0.1, radius=0.04),
    "fading in": FadedOverlay(CIRCLE, start=0.4, fade=0.5),
    "fading in and out": FadedOverlay(CIRCLE, start=0.2, fade=0.6, end=0.5),
}


@pytest.mark.parametrize("name", OVERLAYS)
def test_derivatives(name):
    overlay, h = OVERLAYS[name], 1e-6
    for time in np.linspace(0.05, 1.9, 23):
        before, now, after = (overlay.at(time + d) for d in (-h, 0.0, h))
        assert np.allclose((after[0] - before[0]) / (2 * h), now[1], atol=1e-6)
        assert np.allclose((after[1] - before[1]) / (2 * h), now[2], atol=1e-4)


@pytest.mark.parametrize("name", OVERLAYS)
def test_pure_in_time(name):
    times = np.linspace(0, 3, 40)
    forward = np.array([OVERLAYS[name].at(t)[0] for t in times])
    backward = np.array([OVERLAYS[name].at(t)[0] for t in times[::-1]])[::-1]
    assert (forward == backward).all()


def test_fading_starts_and_ends_with_nothing():
    faded = FadedOverlay(CIRCLE, start=1.0, fade=0.5).end_at(3.0)
    for time in (0.0, 1.0, 3.5, 9.0):
        assert not any(part.any() for part in faded.at(time))
    assert np.allclose(faded.at(2.0)[0], CIRCLE.at(1.0)[0])
    assert faded.is_over(3.5)
    assert not faded.is_over(3.4)


def test_the_spiral_runs_at_constant_speed_and_stays_within_its_radius():
    spiral = OVERLAYS["spiral"]
    for time in np.linspace(0.0, 12.0, 200):
        offset, velocity, _ = spiral.at(time)
        assert np.linalg.norm(velocity) == pytest.approx(0.1, rel=1e-6)
        assert np.linalg.norm(offset) <= 0.04 + 1e-12


def test_the_spiral_turns_as_far_as_its_arc_length_says():
    wide = Spiral(pitch=0.01, speed=0.1, radius=1.0)
    offset, _, _ = wide.at(6.0)
    assert np.linalg.norm(offset) / (0.01 / (2 * np.pi)) == pytest.approx(27.38, abs=0.01)
