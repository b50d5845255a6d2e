"""The force of a push as it is measured: before contact, where it should be none, and while the tool presses."""

from __future__ import annotations

import numpy as np
import pytest

from skillc_runtime.control.guarded_push import measured_force
from skillc_runtime.control.push_memory import (
    LASTED,
    PHASE,
    PRESSING,
    SIZE,
    STEADY,
    add_sample,
    is_sample_due,
    write_push,
)
from skillc_runtime.devices.guarded_push import GuardedPush, MeasuredForce, Travel
from skillc_runtime.primitives.push_force import find_doubt

AXIS, PERIOD = np.array([0.0, 0.0, 1.0]), 0.001


def measure(bias_n: float, approach_s: float, press_s: float, touched_s: float = 0.0) -> MeasuredForce:
    """Approach, the last `touched_s` of it in contact already, and press with 8 N; the signal has a bias."""
    push = np.zeros(SIZE)
    write_push(push, GuardedPush(AXIS, 8.0, 0.05, Travel(1.0)), AXIS)
    push[STEADY] = 1.0
    for step in range(round(approach_s / PERIOD)):
        touches = step * PERIOD > approach_s - touched_s
        if is_sample_due(push, PERIOD):
            add_sample(push, bias_n + (4.0 if touches else 0.0))
    push[PHASE] = PRESSING
    for step in range(round(press_s / PERIOD)):
        push[LASTED] = step * PERIOD
        if is_sample_due(push, PERIOD):
            add_sample(push, bias_n + 8.0)
    return measured_force(push)


def test_a_bias_is_what_is_measured_of_nothing() -> None:
    found = measure(bias_n=0.7, approach_s=1.0, press_s=2.0, touched_s=0.3)
    assert found.free_n == pytest.approx(0.7) and found.pressed_n == pytest.approx(8.7)


@pytest.mark.parametrize(("approach_s", "press_s"), [(0.15, 2.0), (1.0, 0.4)])
def test_too_few_samples_have_no_mean(approach_s: float, press_s: float) -> None:
    found = measure(0.0, approach_s, press_s)
    assert (found.free_n is None) == (approach_s < 0.2) and (found.pressed_n is None) == (press_s < 0.5)


@pytest.mark.parametrize(
    ("free", "pressed", "doubt"),
    [
        (0.1, 8.1, None),
        (0.0, 8.39, None),
        (0.0, 7.59, "the arm measured 7.59 N for 8 N, which may differ by 5%"),
        (0.0, 8.41, "the arm measured 8.41 N for 8 N"),
        (1.0, 8.0, "the arm measured 1.00 N when it touched nothing; less this error it pressed with 7.00 N for 8 N"),
        (-1.0, 7.0, "the arm measured -1.00 N when it touched nothing; less this error it pressed with 8.00 N for 8 N"),
        (None, 8.0, "did not approach steadily for long enough"),
        (0.0, None, "nothing that measures its force, or pressed too briefly"),
    ],
)
def test_a_measurement_outside_its_band_is_told(free: float | None, pressed: float | None, doubt: str | None) -> None:
    found = find_doubt(8.0, MeasuredForce(free, pressed), 0.05)
    assert found is None if doubt is None else found is not None and doubt in found
