"""Differences of reality as text: what rounds to zero has no sign."""

from __future__ import annotations

import pytest

from skillc_runtime.backends.simulation.signed import format_signed, format_tilt


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [(0.04, 1, "0.0"), (-0.04, 1, "0.0"), (-0.06, 1, "-0.1"), (3.0, 0, "+3"), (0.4, 0, "0")],
)
def test_a_number_has_a_sign_unless_it_is_zero(value: float, digits: int, text: str) -> None:
    assert format_signed(value, digits) == text


def test_a_tilt_that_rounds_to_zero_is_not_mentioned() -> None:
    assert format_tilt(0.01, -0.02) == ""
    assert format_tilt(0.01, -0.62) == ", tilted 0.0 and -0.6 deg"
