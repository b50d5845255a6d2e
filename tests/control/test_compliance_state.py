"""Yielding along several axes: directions at right angles can be released, whichever way the tool is turned."""

from __future__ import annotations

import numpy as np
import pytest
from rig import GAINS

from skillc_runtime.control.compliance_state import ComplianceState
from skillc_runtime.motion.pose import exp

TURNS = [exp(np.array(turn)) for turn in ((0.0, 0.0, 0.0), (0.2, -0.15, 0.3), (1.0, 0.4, -0.7), (0.0, 0.0, 0.785))]


@pytest.mark.parametrize("turn", TURNS)
def test_three_directions_at_right_angles_are_released_and_restored(turn: np.ndarray) -> None:
    yielding = ComplianceState(GAINS["iiwa14"])
    for released, direction in enumerate(turn.T, 1):
        yielding.release(direction, 0.0)
        assert yielding.yields(direction)
        assert (yielding.wanted.stiffness[:3] == 0.0).sum() == released
    np.testing.assert_allclose(yielding.wanted.frame.T @ yielding.wanted.frame, np.eye(3), atol=1e-12)
    for _ in turn.T:
        yielding.restore(np.zeros(3))
    assert yielding.stiff


def test_a_push_goes_on_in_its_direction_while_a_second_axis_is_released() -> None:
    yielding = ComplianceState(GAINS["iiwa14"])
    along, across = TURNS[1][:, 2], TURNS[2] @ np.cross(TURNS[2].T @ TURNS[1][:, 2], [1.0, 0.0, 0.0])
    yielding.release(along, 0.0)
    yielding.push(along, 8.0)
    for _ in range(2000):
        yielding.step(0.001)
    yielding.release(across / np.linalg.norm(across), 0.0)
    exerted = yielding.applied.frame @ yielding.applied.wrench[:3]
    np.testing.assert_allclose(exerted, 8.0 * along, atol=0.01)
    np.testing.assert_allclose(yielding.wanted.frame @ yielding.wanted.force, 8.0 * along, atol=1e-9)


def test_a_direction_askew_to_the_released_one_is_refused() -> None:
    yielding = ComplianceState(GAINS["iiwa14"])
    yielding.release(np.array([0.0, 0.0, 1.0]), 0.0)
    with pytest.raises(ValueError, match="parallel or at right angles"):
        yielding.release(np.array([0.0, 0.6, 0.8]), 0.0)
