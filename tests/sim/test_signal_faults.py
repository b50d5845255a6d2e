"""Whole tasks during which the signals of an arm become wrong: it stops at once, and nothing is pressed too hard."""

from __future__ import annotations

import pytest

from safety.fault_trials import try_fault

pytestmark = pytest.mark.sim

WORST = (
    ("iiwa", "speed-negated", "approach"),
    ("iiwa", "speed-negated", "wipe"),
    ("iiwa", "all-frozen", "carry"),
    ("iiwa", "position-jumps", "free"),
    ("iiwa", "all-intermittent", "insert"),
    ("panda", "speed-negated", "press"),
    ("panda", "all-frozen", "approach"),
    ("ur5e", "wrench-frozen", "wipe"),
    ("ur5e", "wrench-zero", "approach"),
    ("ur5e", "wrench-negated", "approach"),
)
"""Those that ended with hundreds to thousands of newtons when nothing looked at the signals, or without a word."""


@pytest.mark.parametrize(("arm", "kind", "phase"), WORST)
def test_an_arm_stops_before_it_presses_too_hard(arm: str, kind: str, phase: str) -> None:
    found = try_fault(arm, kind, phase)
    assert found is not None
    assert found.is_safe, found
    assert found.noticed_s is not None
    assert found.noticed_s < 0.1
    assert "measure" in found.reason
