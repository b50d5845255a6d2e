"""Noticing contact: from the course of speed and force to one word."""

import numpy as np
import pytest

from skillc_runtime.control.push_memory import (
    APPROACH,
    GO_ON,
    NO_CONTACT,
    PRESS,
    SIZE,
    STEADY,
    advance_approach,
    advance_pressing,
    write_push,
)
from skillc_runtime.devices.guarded_push import GuardedPush, Travel

PUSH = GuardedPush(np.array([0.0, 0.0, 1.0]), 10.0, approach_m_s=0.05, travel=Travel(0.12))


OUTCOMES = {GO_ON: "approaching", PRESS: "touching", NO_CONTACT: "missing"}
"""What is known by now, in a word."""


def begun():
    """The push as numbers, at its start."""
    push = np.zeros(SIZE)
    write_push(push, PUSH, PUSH.along)
    return push


COURSES = {
    # name: (speed and force at each ms, what is known at the end)
    "gets going": ([(0.05 * i / 100, 3 - i / 33) for i in range(100)], "approaching"),
    "flies": ([(0.045, 0.3)] * 500, "approaching"),
    "is stopped": ([(0.045, 0.3)] * 500 + [(0.005, 0.9)] * 21, "touching"),
    "is slowed for an instant": ([(0.045, 0.3)] * 500 + [(0.005, 0.9)] * 15 + [(0.04, 0.3)] * 5, "approaching"),
    "is pressed": ([(0.045, 0.3)] * 500 + [(0.04, 2.5)] * 6, "touching"),
    "feels a spike": ([(0.045, 0.3)] * 500 + [(0.04, 9.0)] * 2 + [(0.04, 0.5)], "approaching"),
    "bounces twice": ([(0.045, 0.3)] * 500 + ([(-0.01, 1.0)] * 10 + [(0.03, 0.5)] * 10) * 2, "approaching"),
    "touches from the start": ([(0.0005, 2.9)] * 501, "touching"),
    "falls at first": (
        [(0.0, 8.0)] * 20 + [(0.002 * i, 8 - i / 10) for i in range(70)] + [(0.14, -4.0)] * 100,
        "approaching",
    ),
    "falls, then approaches, then is pressed": (
        [(0.002 * i, 8 - i / 10) for i in range(70)] + [(0.14, -4.0)] * 100 + [(0.05, 0.2)] * 30 + [(0.04, 2.5)] * 6,
        "touching",
    ),
    "falls and lies there": ([(0.14, -4.0)] * 100 + [(0.0, 3.0)] * 501, "touching"),
    "moves away at first": ([(-0.1, 9.0)] * 100 + [(-0.1 + 0.0015 * i, 9 - i / 12) for i in range(95)], "approaching"),
    "meets nothing": ([(0.045, 0.3)] * 3000, "missing"),
}


@pytest.mark.parametrize("name", COURSES)
def test_course(name):
    samples, expected = COURSES[name]
    push = begun()
    for speed, force in samples:
        action = advance_approach(push, speed, force, 0.001)
    assert OUTCOMES[action] == expected


def test_it_takes_as_long_at_every_rate():
    for period in (0.001, 0.002, 0.004):
        push, action, time = begun(), GO_ON, 0.0
        push[STEADY] = 1.0
        while action == GO_ON:
            action, time = advance_approach(push, 0.0, 0.0, period), time + period
        assert time == pytest.approx(0.02, abs=period)


PRESSED = {
    # name: (speed at each ms, whether it falls in the end)
    "rests": ([0.0] * 500, False),
    "goes along a slope": ([0.012] * 500, False),
    "presses in a spring": ([0.09] * 40, False),
    "falls": ([0.002 * i for i in range(70)], True),
    "is pushed for an instant": ([0.3] * 9 + [0.0], False),
    "is lifted": ([-0.3] * 100, False),
}


@pytest.mark.parametrize("name", PRESSED)
def test_a_pressed_tool(name):
    speeds, falling = PRESSED[name]
    push = begun()
    for speed in speeds:
        action = advance_pressing(push, speed, 0.001)
    assert (action == APPROACH) == falling
