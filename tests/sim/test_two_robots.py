"""Two robots in one cell work at the same time, from one goal; where they need the same tool, one hands it over."""

from __future__ import annotations

from functools import cache

import pytest

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.history.history import RecordedCall
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.labels.labelled import LabelledIri
from skillc_runtime.world.state.model import WorldModel

pytestmark = pytest.mark.sim


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


def run(name: str) -> tuple[TaskResult, dict[str, list[RecordedCall]]]:
    """Run a task; return its result and the steps of each robot's arm in order."""
    task = library().tasks[name]
    assert task.scene is not None and task.goal is not None
    state = load_scene(catalogue.scene_path(task.scene), library().vocabulary)
    prepared = prepare_task(Assignment(name, state, AchieveGoal(task.goal)), library())
    assert isinstance(prepared, PreparedTask), prepared
    cell, told = SimulatedCell(WorldModel(state), seed=4), HistoryBuilder()
    execution = execute_task(prepared, library(), cell, [told])
    wipings = find_wipings(told.history, cell.world.snapshot())
    result = summarise_run(execution, told.history, wipings, cell)
    steps: dict[str, list[RecordedCall]] = {}
    for call in told.history.attempts[-1].steps:
        arm = call.bindings["arm"]
        assert isinstance(arm, LabelledIri)
        steps.setdefault(arm.label, []).append(call)
    return result, steps


def names(calls: list[RecordedCall]) -> list[str]:
    return [call.skill for call in calls]


def check_quality(result: TaskResult) -> None:
    assert result.status == "succeeded", result.failure
    assert {str(wiping.surface) for wiping in result.wipings} == {"lab:Whiteboard-1", "lab:Table-1"}
    for wiping in result.wipings:
        assert wiping.coverage >= 0.99 and wiping.contact_lost <= 0.01
        assert abs(wiping.force_mean_n / wiping.force_command_n - 1) <= 0.1


def test_each_with_a_tool_of_its_own_they_work_side_by_side() -> None:
    result, steps = run("clean_both")
    check_quality(result)
    lasted = [sum((call.ended or 0.0) - (call.started or 0.0) for call in calls) for calls in steps.values()]
    assert len(lasted) == 2
    assert result.sim_time_s < max(lasted) + 1.0


def test_a_shared_tool_is_put_down_by_one_before_the_other_takes_it() -> None:
    result, steps = run("share_eraser")
    check_quality(result)
    fixed, mobile = steps["lab:Iiwa-1"], steps["lab:Ur5e-1"]
    assert names(fixed) == ["Pick", "Wipe", "Place"]
    assert names(mobile) == ["Drive", "Pick", "Drive", "Wipe"]
    assert mobile[0].started == fixed[0].started, "it drives up while the other still wipes"
    assert (mobile[1].started or 0.0) >= (fixed[-1].ended or 0.0)
