"""A thing within reach by distance, at which no posture brings the hand, is out of reach; the others are not."""

from __future__ import annotations

from pathlib import Path

import pytest

from bodies.test_trays import FOLDER, PART, library
from random_cells.spoiling import draw_case
from random_cells.writing import TASK, write_cell
from skillc.services.cell_checks.checks import check_cell
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.scene.load import load_scene
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frames import relocation_changes
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.terms import CONTAINER, FURNITURE
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import at, lab, thing


def cell(*changes: Change) -> WorldState:
    """Return the cell of a Panda whose base is at (0, 0, 0.6) m and whose reach is 0.86 m."""
    return load_scene(FOLDER / "cell.ttl", library().vocabulary).with_changes(changes)


def stand(x: float, y: float, top: float) -> list[Change]:
    return thing("Stand", at(x, y, top), size=(0.15, 0.15, top), cls=FURNITURE)


def found(state: WorldState) -> list[SceneViolation]:
    return [each for each in check_cell(state) if each.name == "out-of-reach"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("place", "severity"),
    [
        ((0.0, 0.5, 0.5), None),
        ((0.0, 0.7, 0.6), None),
        ((0.0, 0.5, 1.2), "warning"),
        ((0.0, 0.3, 1.5), "error"),
    ],
)
def test_a_part_that_no_posture_grasps_from_above_is_out_of_reach(
    place: tuple[float, float, float], severity: str | None
) -> None:
    x, y, top = place
    moved = relocation_changes(cell(), PART, at(x, y, top + 0.015))
    reported = found(cell(*stand(x, y, top), *moved))
    assert [each.severity for each in reported] == ([] if severity is None else [severity])
    assert all("no posture of lab:Panda-1 brings the hand where it would grasp it" in each.message for each in reported)


@pytest.mark.slow
@pytest.mark.parametrize(("height", "reached"), [(0.6, True), (1.45, False)])
def test_a_bin_into_which_no_posture_brings_a_hand_is_out_of_reach(height: float, reached: bool) -> None:
    bin_ = thing("Bin", at(0.0, 0.4, height + 0.05), size=(0.15, 0.15, 0.1), cls=CONTAINER)
    reported = found(cell(*stand(0.0, 0.4, height), *bin_))
    assert [each.individual for each in reported] == ([] if reached else [lab("Bin")])


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(0, 12, 2))
def test_nothing_is_out_of_reach_in_a_cell_that_can_be_solved(seed: int, tmp_path: Path) -> None:
    case = draw_case(seed)
    assert case.trouble == "none"
    write_cell(case.believed, tmp_path)
    with load_task(RunSpec(task=f"{tmp_path}:{TASK}"), SilentReporter()) as task:
        assert found(task.assignment.state) == []
