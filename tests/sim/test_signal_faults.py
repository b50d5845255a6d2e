"""Whole tasks during which the signals of an arm become wrong: it stops at once, and nothing is pressed too hard."""

from __future__ import annotations

import pytest

from safety.fault_trials import try_fault
from skillc_runtime.backends.simulation.arms.signal_faults import FaultKind

pytestmark = pytest.mark.sim

WORST = (
    ("iiwa", "speed-negated", "approach", 0.1),
    ("iiwa", "all-frozen", "carry", 0.1),
    ("iiwa", "position-jumps", "free", 0.1),
    ("iiwa", "all-intermittent", "insert", 0.1),
    ("panda", "speed-negated", "press", 0.1),
    ("ur5e", "wrench-frozen", "wipe", 0.1),
    ("ur5e", "wrench-zero", "approach", 0.1),
    ("ur5e", "wrench-negated", "approach", 0.3),
)
"""Those that ended with hundreds to thousands of newtons when nothing looked at the signals, or without a word; within
how many s they have to be noticed: a force of the wrong sign from when there is one, however slowly the tool comes."""


HARD_N = 60.0
"""No more than this on anything before the arm has stopped; its limit is 80 N."""


@pytest.mark.parametrize(("arm", "kind", "phase", "within_s"), WORST)
def test_an_arm_stops_before_it_presses_too_hard(arm: str, kind: FaultKind, phase: str, within_s: float) -> None:
    found = try_fault(arm, kind, phase)
    assert found is not None
    assert found.is_safe, found
    assert found.noticed_s is not None
    begins_s = found.touched_s if kind == "wrench-negated" else 0.0
    assert begins_s is not None
    assert found.noticed_s - begins_s < within_s
    assert found.force_n < HARD_N
    assert "measure" in found.reason
