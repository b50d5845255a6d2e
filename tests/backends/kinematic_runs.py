"""Running tasks in kinematic cells."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldModel

TASK = re.compile(r"^task (\w+)", re.MULTILINE)


@cache
def library(name: str) -> SkillLibrary:
    """Return a shipped library."""
    return compile_valid(find_library(SHIPPED / name))


def shipped_tasks() -> dict[str, str]:
    """Return the library of every shipped task, by its text: tests are named by them, before anything is compiled."""
    files = ((name, file) for name in ("contact", "wiping") for file in (SHIPPED / name).rglob("*.skill"))
    return {task: name for name, file in files for task in TASK.findall(file.read_text("utf-8"))}


def prepare(compiled: SkillLibrary, name: str, scene: Path, changes: Sequence[Change] = ()) -> PreparedTask:
    """Plan a task of a library in a scene, whose facts are changed before."""
    task, state = compiled.tasks[name], load_scene(scene, compiled.vocabulary).with_changes(changes)
    if task.goal is not None:
        objective: AchieveGoal | ExecuteBody = AchieveGoal(task.goal)
    else:
        assert task.body is not None
        objective = ExecuteBody(task.body)
    prepared = prepare_task(Assignment(name, state, objective), compiled)
    assert isinstance(prepared, PreparedTask), prepared
    return prepared


def run_task(compiled: SkillLibrary, name: str, scene: Path) -> tuple[Execution[KinematicCell], TaskResult]:
    """Run a task of a library; return its execution and its result."""
    prepared = prepare(compiled, name, scene)
    state = prepared.assignment.state
    cell, told = KinematicCell(WorldModel(state)), HistoryBuilder()
    execution = execute_task(prepared, compiled, cell, [told])
    wipings = find_wipings(told.history, cell.world.snapshot())
    return execution, summarise_run(execution, told.history, wipings, cell)


def run_shipped(name: str) -> tuple[Execution[KinematicCell], TaskResult]:
    """Run a shipped task; return its execution and its result."""
    compiled = library(shipped_tasks()[name])
    scene = compiled.tasks[name].scene
    assert scene is not None
    return run_task(compiled, name, catalogue.scene_path(scene))
