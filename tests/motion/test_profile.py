"""Trapezoids: limits, ends, derivatives."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc_runtime.motion.paths.profile import trapezoidal_profile

positive = st.floats(0.01, 5.0)


@given(st.floats(1e-3, 3.0), positive, positive, positive, st.floats(0.0, 1.0), st.floats(1.0, 3.0))
def test_derivatives_and_limits(length, speed, acceleration, deceleration, share, slower):
    profile = trapezoidal_profile(length, speed, acceleration, deceleration)
    profile = profile.stretch_to(profile.duration * slower)
    time, h = share * profile.duration, 1e-6 * profile.duration
    place, rate, _ = profile.at(time)
    before, after = profile.at(time - h)[0], profile.at(time + h)[0]
    assert 0 <= place <= length * (1 + 1e-12)
    assert 0 <= rate <= speed * (1 + 1e-12)
    assert (after - before) / (2 * h) == pytest.approx(rate, abs=2 * max(acceleration, deceleration) * h + 1e-7)


@given(st.floats(1e-3, 3.0), positive, positive)
def test_starts_and_ends_at_rest(length, speed, acceleration):
    profile = trapezoidal_profile(length, speed, acceleration)
    assert profile.at(-1.0) == (0.0, 0.0, 0.0)
    assert profile.at(profile.duration + 1.0) == (length, 0.0, 0.0)
    assert profile.at(profile.duration * (1 - 1e-9))[0] == pytest.approx(length)


def test_nothing_to_do_takes_no_time():
    assert trapezoidal_profile(0.0, 1.0, 1.0).duration == 0.0
    assert trapezoidal_profile(0.0, 1.0, 1.0).stretch_to(2.0).at(1.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("length, speed, acceleration", [(-1.0, 1.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, -1.0)])
def test_refuses_nonsense(length, speed, acceleration):
    with pytest.raises(ValueError, match="profile"):
        trapezoidal_profile(length, speed, acceleration)
