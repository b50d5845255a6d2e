"""A surface is clean only because an inspection measured it so."""

import numpy as np
import pytest
from cells import LAB, SURFACE, cell, world

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.checkpoint import decode_checkpoint
from skillc_runtime.motion.dirt_map import parse_dirt_map
from skillc_runtime.primitives.inspect import CLEAN_THRESHOLD, COVERAGE, DIRT_MAP, Inspect
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.space.dirt import work_layout
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, ClearProperty, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.facts import PropertyFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.terms import HAS_SHEET, INSPECTION_CAMERA, INSPECTION_SHEET, IS_CLEAN, SKILLC, WIPING

SHEET = SKILLC + "inspection-camera-sheet"
TABLE = SURFACE["iiwa_table"]


def inspect_table(there: SimulatedCell) -> None:
    inspect = Inspect(there, surface=TABLE)
    inspect.start()
    assert inspect.tick() is Status.SUCCESS


@pytest.mark.parametrize(("unwiped_cells", "clean"), [(4800, False), (49, False), (48, True), (0, True)])
def test_clean_is_what_reaches_the_threshold(unwiped_cells: int, clean: bool) -> None:
    there = cell("iiwa_table")
    there.world.commit([SetProperty(TABLE, CLEAN_THRESHOLD, 0.99)])
    dose = there.coverage[TABLE].dose
    assert dose.size == 4800, "60 x 80 cells, of which 1 % may stay unwiped"
    dose.flat[unwiped_cells:] = 1.0
    inspect_table(there)
    state = there.world.snapshot()
    assert state.value(TABLE, IS_CLEAN) is clean
    assert state.value(TABLE, COVERAGE) == pytest.approx(1 - unwiped_cells / 4800)


def test_whoever_changes_what_is_clean_enough_changes_whether_it_is_clean() -> None:
    there = cell("iiwa_table")
    there.coverage[TABLE].dose.flat[48:] = 1.0
    there.world.commit([SetProperty(TABLE, CLEAN_THRESHOLD, 1.0)])
    assert there.world.snapshot().value(TABLE, IS_CLEAN) is False, "as the scene says: nothing was measured"
    inspect_table(there)
    clean = PropertyFact(TABLE, IS_CLEAN)
    assert there.world.snapshot().value(TABLE, IS_CLEAN) is False
    write = there.world.deciding_write(clean)
    assert write is not None
    assert (write.evidence, write.origin) == ("idealised", "Inspect")
    there.world.commit([SetProperty(TABLE, CLEAN_THRESHOLD, 0.99)], "somebody", None)
    assert there.world.snapshot().value(TABLE, IS_CLEAN) is True
    there.world.commit([SetProperty(TABLE, COVERAGE, 1.0), SetProperty(TABLE, IS_CLEAN, False)])
    assert there.world.snapshot().value(TABLE, IS_CLEAN) is False, "what is stated is not judged"


def test_the_map_of_the_last_inspection_says_where_to_wipe_and_is_not_the_truth() -> None:
    there = cell("iiwa_table")
    dose = there.coverage[TABLE].dose
    dose[:] = 1.0
    dose[30:40, 20:32] = 0.0
    inspect_table(there)
    state = there.world.snapshot()
    text = state.value(TABLE, DIRT_MAP)
    assert isinstance(text, str)
    dirt = parse_dirt_map(text)
    assert (dirt.columns, dirt.rows) == (60, 80)
    assert dirt.dirty_share == pytest.approx(120 / 4800)
    assert dirt.clean_share == state.value(TABLE, COVERAGE)
    (patch,) = work_layout(state, TABLE).patches
    assert patch.size == pytest.approx([0.12, 0.12])
    assert property_of(state, TABLE, WIPING + "patchShare") == pytest.approx(0.12)
    again = SimulatedCell(WorldModel(state))
    assert again.camera().inspect(TABLE) == state.value(TABLE, COVERAGE), "what was seen clean is so in a new cell"
    saved = there.save()
    there.world.commit([SetProperty(TABLE, DIRT_MAP, "1x1 1c")])
    resumed = SimulatedCell(there.world, checkpoint=decode_checkpoint(saved))
    assert resumed.coverage[TABLE].wiped_share == state.value(TABLE, COVERAGE), "the map is not the truth"


def test_a_map_that_cannot_be_read_is_said_to_be_so() -> None:
    state = world("iiwa_table").with_changes([SetProperty(TABLE, DIRT_MAP, "60x80 1d")])
    with pytest.raises(SheetError, match="dirtMap of lab:Table-1 cannot be read: it has 1 cells in place of"):
        SimulatedCell(WorldModel(state))


def seen_clean(rate: float, name: str, dose: float, seed: int = 0) -> float:
    """Return the seen share of a table, all of which was wiped for `dose` s, with a rate on the camera's sheet."""
    changed = world("iiwa_table").with_changes([SetProperty(SHEET, SKILLC + name, rate)])
    there = SimulatedCell(WorldModel(changed), seed)
    there.coverage[TABLE].dose[:] = dose
    return there.camera().inspect(TABLE)


def test_false_alarms_and_misses_are_seen_if_they_are_many_and_outvoted_if_they_are_few() -> None:
    assert seen_clean(0.01, "falseAlarmRate", 1.0) == 1.0
    assert 0.85 < seen_clean(0.3, "falseAlarmRate", 1.0) < 0.95, "5 of 9 images or more are wrong in 10 % of the spots"
    assert seen_clean(0.01, "missRate", 0.0) == 0.0
    assert 0.05 < seen_clean(0.3, "missRate", 0.0) < 0.15
    assert (
        seen_clean(0.3, "missRate", 0.0, 1) == seen_clean(0.3, "missRate", 0.0, 1) != seen_clean(0.3, "missRate", 0.0)
    )


def test_a_camera_of_the_scene_replaces_the_usual_one() -> None:
    eye, sheet = LAB + "Eye", LAB + "eye-sheet"
    changes = [
        AddIndividual(eye, (INSPECTION_CAMERA,)),
        AddIndividual(sheet, (INSPECTION_SHEET,)),
        AddRelation(eye, HAS_SHEET, sheet),
        SetProperty(sheet, SKILLC + "imagesPerInspection", 1),
        SetProperty(sheet, SKILLC + "falseAlarmRate", 0.5),
    ]
    there = SimulatedCell(WorldModel(world("iiwa_table").with_changes(changes)))
    there.coverage[TABLE].dose[:] = 1.0
    assert 0.45 < there.camera().inspect(TABLE) < 0.55


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
