"""A Franka Research 3 does the tasks of the Panda, in the Panda's scenes with another class and data sheet."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

TASKS = [
    pytest.param("contact", "press_button_panda", marks=pytest.mark.sim),
    *(
        pytest.param(*task, marks=[pytest.mark.sim, pytest.mark.long])
        for task in (
            ("wiping", "clean_desk"),
            ("sorting", "sort_parts"),
            ("contact", "insert_peg"),
            ("contact", "teach_pose_panda"),
        )
    ),
]


@pytest.mark.parametrize(("library_name", "task_name"), TASKS)
def test_what_the_panda_does_it_does(library_name: str, task_name: str, tmp_path: Path) -> None:
    found = find_library(SHIPPED / library_name)
    library = libraries.compile_library(found).value
    task = library.tasks[task_name]
    assert task.scene is not None
    assert task.goal is not None
    shipped = SHIPPED / library_name / task.scene
    scene = (shipped if shipped.exists() else catalogue.scene_path(task.scene)).read_text("utf-8")
    own = scene.replace("skillc:Panda ;", "skillc:Fr3 ;").replace("skillc:panda-sheet", "skillc:fr3-sheet")
    assert own.count("skillc:Fr3") == own.count("skillc:fr3-sheet") == 1
    (tmp_path / "cell.ttl").write_text(own, "utf-8")
    state = load_scene(tmp_path / "cell.ttl", library.vocabulary)
    prepared = prepare_task(Assignment(task_name, state, AchieveGoal(task.goal)), library)
    assert isinstance(prepared, PreparedTask), prepared
    execution = execute_task(prepared, library, SimulatedCell(WorldModel(state), seed=3), [])
    assert execution.status == "succeeded", execution.failure
