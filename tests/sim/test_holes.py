"""Surfaces with holes and patches, wiped whole where they are to be wiped, and nowhere else."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import ALONG_AXIS, HAS_HOLE, HAS_PATCH, SIZE, SKILLC

pytestmark = pytest.mark.sim

LAB = "http://example.org/lab#"
TABLE, OUTLET, LABEL = (LAB + name for name in ("Table-1", "Outlet-1", "Label-1"))
LOW_M = 0.01
"""Nearer to the table than this, a tool that was over a hole would touch what is there."""


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


def area(name: str, x: float, y: float, width: float, height: float) -> list[Change]:
    """The facts of a patch of the table."""
    iri = LAB + name
    sizes = [SetProperty(iri, term, value) for term, value in zip(SIZE, (width, height), strict=False)]
    place = placement_changes(iri, Pose.of((x, y, 0.0)), "table")
    return [AddIndividual(iri, (SKILLC + "Area",)), *place, *sizes, AddRelation(TABLE, HAS_PATCH, iri)]


PATCHES: list[Change] = [
    *area("Left", 0.0, 0.13, 0.28, 0.12),
    *area("Right", -0.08, -0.12, 0.12, 0.14),
    SetProperty(TABLE, ALONG_AXIS, "x"),
    RemoveRelation(TABLE, HAS_HOLE, OUTLET),
]


@pytest.mark.parametrize("changes, seed", [([], 0), (PATCHES, 1)], ids=["holes", "patches"])
def test_all_that_is_to_be_wiped_is_wiped_and_no_hole_is_touched(changes: list[Change], seed: int) -> None:
    task = library().tasks["clean_around"]
    assert task.scene is not None
    assert task.goal is not None
    state = load_scene(catalogue.scene_path(task.scene), library().vocabulary).with_changes(changes)
    prepared = prepare_task(Assignment("clean_around", state, AchieveGoal(task.goal)), library())
    assert isinstance(prepared, PreparedTask), prepared
    cell, told = SimulatedCell(WorldModel(state), seed), HistoryBuilder()
    execution = execute_task(prepared, library(), cell, [told])
    wipings = find_wipings(told.history, cell.world.snapshot())
    result = summarise_run(execution, told.history, wipings, cell)
    assert result.status == "succeeded", result.failure
    assert result.wiping is not None
    assert result.wiping.coverage == 1.0
    assert result.wiping.contact_lost == 0.0
    assert result.wiping.force_mean_n == pytest.approx(18.0, rel=0.05)
    assert len(wipings[0].strokes) == (2 if changes else 1)
    assert gaps(cell, along=0 if changes else 1).min() > 0.0


def gaps(cell: SimulatedCell, along: int) -> Array:
    """How far from each hole the edge of the low tool is, m, at every step; its longer side is along an axis."""
    (surface,) = cell.scene.surfaces
    frame, recording = cell.ground_truth.surface_pose(surface.individual), cell.ground_truth.recording(LAB + "Eraser-1")
    places = (recording.position - frame.position) @ frame.rotation
    low = places[places[:, 2] < LOW_M, :2]
    assert len(low) > 10_000
    half = np.array([0.05, 0.025] if along == 0 else [0.025, 0.05])
    holes = surface.layout.holes
    assert holes
    return np.array([(np.abs(low - hole.centre) - half - hole.size / 2).max(axis=1) for hole in holes])
