"""An arm that does not know its weight is tared before it puts something down, unless it may feel a contact."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from cells import ARM, ERASER, LAB, PLACE, at_the_eraser

from skillc_runtime.primitives import support
from skillc_runtime.primitives.support import NOTHING_N, SupportCheck
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.terms import CONTACT, DEPTH

SCENE, HOLE = "iiwa_table", LAB + "Hole-1"


def begin(monkeypatch: pytest.MonkeyPatch, felt_n: float, far_m: float, in_hole: bool = False) -> tuple[int, int]:
    """Return how often an arm was asked to be tared, and to yield, when it begins to put an eraser down."""
    there, asked = at_the_eraser(SCENE), {"tare": 0, "yield": 0}
    arm = there._drivers[ARM[SCENE]]
    arm.measured.felt_wrench = lambda: np.array([0.0, 0.0, felt_n, 0.0, 0.0, 0.0])

    def count(what: str, answer: Any) -> Any:
        asked[what] += 1
        return answer

    monkeypatch.setattr(type(arm.compliance), "tare", lambda self: count("tare", False))
    monkeypatch.setattr(support, "yield_along", lambda *_: count("yield", None))
    monkeypatch.setattr(support, "find_nearest", lambda *_: ("lab:Table-1", far_m))
    to = HOLE if in_hole else PLACE[SCENE]
    if in_hole:
        hole = [AddIndividual(HOLE, (CONTACT + "Socket",)), SetProperty(HOLE, DEPTH, 0.03)]
        there.world.commit(hole, "test", "assumed")
    check = SupportCheck(there, ARM[SCENE], ERASER, to)
    monkeypatch.setattr(check, "_press", SimpleNamespace(start=lambda: None))
    check.start()
    return asked["tare"], asked["yield"]


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_what_is_felt_of_nothing_is_tared_before_the_arm_yields(monkeypatch: pytest.MonkeyPatch, sign: float) -> None:
    assert begin(monkeypatch, sign * 2 * NOTHING_N, 0.01) == (1, 0)


@pytest.mark.parametrize(("felt_n", "far_m", "in_hole"), [(0.5, 0.01, False), (8.0, 0.001, False), (8.0, 0.02, True)])
def test_a_contact_is_not_tared(monkeypatch: pytest.MonkeyPatch, felt_n: float, far_m: float, in_hole: bool) -> None:
    """Nor an arm that feels next to nothing: it would only wait. What stands in a hole touches its walls."""
    assert begin(monkeypatch, felt_n, far_m, in_hole) == (0, 1)
