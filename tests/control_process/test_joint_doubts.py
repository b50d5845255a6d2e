"""What measured joints and forces tell of wrong facts, in the words of who has to correct them."""

from __future__ import annotations

import numpy as np
import pytest

from skillc_runtime.backends.control_process.joint_doubts import (
    find_beyond,
    find_confusion,
    find_opposite_speeds,
    find_opposite_weights,
)
from skillc_runtime.backends.control_process.observing import describe_felt, observe_base
from skillc_runtime.motion.pose import Pose

NAMES = ("J1", "J2", "J3")
HOME = np.array([0.1, -1.2, 2.0])
RANGES = np.tile([-3.0, 3.0], (3, 1))


@pytest.mark.parametrize(
    ("q", "said"),
    [
        (HOME, None),
        (HOME + 0.5, None),
        (HOME * [1.0, -1.0, 1.0], "J2 turned the other way"),
        (HOME * [1.0, -1.0, -1.0], "J2 and J3 turned the other way"),
        (HOME[[0, 2, 1]], "J2 and J3 were exchanged"),
    ],
)
def test_signs_and_order_are_known_at_home(q: np.ndarray, said: str | None) -> None:
    found = find_confusion(NAMES, q, HOME)
    assert found is None if said is None else found is not None and said in found


def test_degrees_are_beyond_the_range() -> None:
    assert find_beyond(NAMES, HOME, RANGES) is None
    found = find_beyond(NAMES, np.degrees(HOME), RANGES)
    assert found is not None and found.startswith("J1 is at 5.73, ") and "is it in degrees" in found


def test_speeds_and_weights_with_another_sign_are_named() -> None:
    q, dq = np.linspace(HOME, HOME + np.array([0.1, 0.0, 0.1]), 5), np.tile([0.1, 0.0, -0.1], (5, 1))
    assert list(find_opposite_speeds(NAMES, q, dq)) == ["J3 moves by +0.10 rad while it reports a speed of -0.10 rad/s"]
    weights = list(find_opposite_weights(NAMES, np.array([1.0, 20.0, 8.0]), np.array([-1.0, 19.0, -7.0])))
    assert len(weights) == 1 and weights[0].startswith("J3 measures -7.0 N m, and carries +8.0 N m by the model")


def test_a_force_at_rest_is_told_as_a_mass_or_as_an_offset() -> None:
    assert "9.8 N down at rest: if nothing touches it, the scene has 1.00 kg less" in describe_felt(
        np.array([0, 0, -9.81])
    )
    assert "up at rest: if nothing touches it, the scene has 0.50 kg more" in describe_felt(np.array([0, 0.5, 4.905]))
    assert "has to be tared" in describe_felt(np.array([6.0, 0.0, 1.0]))


def test_a_base_elsewhere_is_remarked() -> None:
    there = Pose.of((1.0, 2.0, 0.0))
    assert observe_base("Heron-1", Pose.of((1.01, 2.0, 0.0)), there).remarks == ()
    (remark,) = observe_base("Heron-1", Pose.of((1.3, 2.4, 0.0)), there).remarks
    assert remark == "it is 0.50 m and 0 deg away from where the scene has it"
