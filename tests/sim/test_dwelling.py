"""Lanes without an overlay: the tool itself hardly dwells at corners, in both modes of arms."""

from __future__ import annotations

from functools import cache

import pytest
from msgspec import structs

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.conditions import Literal
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

pytestmark = pytest.mark.sim

WIPE, TARGET_S = "Wipe.wipe_lanes", 0.02


@cache
def without_overlay() -> SkillLibrary:
    """Return the library for wiping, whose circle has no radius."""
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    library: SkillLibrary = outcome.value
    wipe = library.implementations[WIPE]
    none = {"radius": Literal(0.0)}
    parameters = (structs.replace(each, default=none.get(each.name, each.default)) for each in wipe.parameters)
    changed = structs.replace(wipe, parameters=tuple(parameters))
    assert changed != wipe
    return structs.replace(library, implementations={**library.implementations, WIPE: changed})


def wiped(name: str) -> WipingResult:
    library = without_overlay()
    task = library.tasks[name]
    assert task.scene is not None and task.goal is not None
    state = load_scene(catalogue.scene_path(task.scene), library.vocabulary)
    prepared = prepare_task(Assignment(name, state, AchieveGoal(task.goal)), library)
    assert isinstance(prepared, PreparedTask), prepared
    cell, told = SimulatedCell(WorldModel(state), seed=1), HistoryBuilder()
    execution = execute_task(prepared, library, cell, [told])
    wipings = find_wipings(told.history, cell.world.snapshot())
    result = summarise_run(execution, told.history, wipings, cell)
    assert result.wiping is not None, result.failure
    return result.wiping


@pytest.mark.parametrize("name", ["clean_whiteboard", "clean_table"])
def test_the_tool_does_not_dwell_where_lanes_turn(name: str) -> None:
    found = wiped(name)
    assert found.lane_dwell_of == "tool"
    assert found.lane_dwell_s is not None and found.lane_dwell_s <= TARGET_S
    assert found.coverage == 1.0
