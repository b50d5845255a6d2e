"""A surface is clean only because an inspection measured it so."""

import numpy as np
import pytest
from cells import SURFACE, cell

from skillc_runtime.primitives.inspect import CLEAN_THRESHOLD, COVERAGE, IS_CLEAN, Inspect
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.state.changes import ClearProperty, SetProperty

TABLE = SURFACE["iiwa_table"]


@pytest.mark.parametrize(("unwiped_cells", "clean"), [(4800, False), (49, False), (48, True), (0, True)])
def test_clean_is_what_reaches_the_threshold(unwiped_cells: int, clean: bool) -> None:
    there = cell("iiwa_table")
    there.world.commit([SetProperty(TABLE, CLEAN_THRESHOLD, 0.99)])
    dose = there.coverage[TABLE].dose
    assert dose.size == 4800, "60 x 80 cells, of which 1 % may stay unwiped"
    dose.flat[unwiped_cells:] = 1.0
    inspect = Inspect(there, surface=TABLE)
    inspect.start()
    assert inspect.tick() is Status.SUCCESS
    state = there.world.snapshot()
    assert state.value(TABLE, IS_CLEAN) is clean
    assert state.value(TABLE, COVERAGE) == pytest.approx(1 - unwiped_cells / 4800)


def test_a_surface_without_threshold_is_not_judged() -> None:
    there = cell("iiwa_table")
    there.world.commit([ClearProperty(TABLE, CLEAN_THRESHOLD)])
    with pytest.raises(SkillFailure, match="cleanThreshold"):
        Inspect(there, surface=TABLE).start()


def test_an_unknown_surface_cannot_be_seen() -> None:
    with pytest.raises(KeyError):
        cell("iiwa_table").camera().inspect("http://example.org/lab#Elsewhere")


def test_a_fresh_surface_is_unwiped() -> None:
    there = cell("ur5e_whiteboard")
    assert np.count_nonzero(there.coverage[SURFACE["ur5e_whiteboard"]].dose) == 0
    assert there.camera().inspect(SURFACE["ur5e_whiteboard"]) == 0.0
