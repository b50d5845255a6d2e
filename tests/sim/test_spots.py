"""Where a map shows that little of a table is dirty, only that is wiped; what is left then is seen and wiped again."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from backends.kinematic_runs import library, prepare
from simulation.cells import LAB
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, DirtMap, format_dirt_map
from skillc_runtime.recording.events import Event, ImplementationChosen
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import COVERAGE, DIRT_MAP

pytestmark = pytest.mark.sim
TABLE = LAB + "Table-1"


def dirty_at(*spots: tuple[slice, slice]) -> str:
    """Return a map of the table, in cells of 1 cm, that is dirty in rows and columns."""
    state = np.full((40, 30), CLEAN, dtype=np.uint8)
    for rows, columns in spots:
        state[rows, columns] = DIRTY
    return format_dirt_map(DirtMap(30, 40, state.tobytes(), bytes([10]) * state.size))


ALL, SPOT = dirty_at((slice(None), slice(None))), dirty_at((slice(12, 22), slice(18, 24)))
"""All of the table, and 5 % of it."""


def clean(dirt: str, really: Sequence[slice] = ()) -> tuple[float, Execution[KinematicCell], list[str]]:
    """Return how long a table is planned to be cleaned, the run, and how it was wiped.

    really: rows of the true cells of 5 mm that are dirty although the map says otherwise.
    """
    compiled, ways = library("wiping"), list[str]()
    prepared = prepare(
        compiled, "clean_table", catalogue.scene_path("iiwa_table"), [SetProperty(TABLE, DIRT_MAP, dirt)]
    )
    cell = KinematicCell(WorldModel(prepared.assignment.state))
    for rows in really:
        cell.coverage[TABLE].clean[rows, :20] = False

    def listen(event: Event) -> None:
        if isinstance(event, ImplementationChosen) and event.skill == "Wipe":
            ways.append(event.implementation.rpartition(".")[2])

    assert prepared.planned is not None
    return prepared.planned.solved.plan.duration_s, execute_task(prepared, compiled, cell, [listen]), ways


def test_a_spot_takes_less_time_than_all_of_a_table_in_the_plan_and_in_the_run() -> None:
    planned, ended, ways = clean(SPOT)
    assert ended.status == "succeeded"
    assert ways == ["wipe_spots", "wipe_strokes"]
    planned_for_all, ended_all, ways_all = clean(ALL)
    assert ended_all.status == "succeeded"
    assert ways_all == ["wipe_lanes"]
    assert planned + 20.0 < planned_for_all
    assert ended.backend.now + 20.0 < ended_all.backend.now


def test_what_nobody_knew_to_be_dirty_is_seen_said_and_wiped_again() -> None:
    _, ended, ways = clean(SPOT, [slice(70, 80)])
    assert ended.status == "succeeded"
    assert ways == 2 * ["wipe_spots", "wipe_strokes"]
    first = ended.attempts[0].failure
    assert first is not None
    assert "lab:Table-1.isClean is false (coverage 0.958333 of 1)" in str(first)
    state = ended.backend.cell.world.snapshot()
    assert state.value(TABLE, COVERAGE) == 1.0
    assert state.value(TABLE, DIRT_MAP) == "60x80 4800c"
