"""A shipped skill runs through a control process on a robot of another process; `robots.bodies` has longer ones."""

from __future__ import annotations

import pytest

from backends.kinematic_runs import library, prepare, shipped_tasks
from control_process.toy_link import MUCH_PATIENCE, toy_cell
from skillc_ontology import catalogue
from skillc_runtime.execution.execute import execute_task

pytestmark = pytest.mark.robot


def test_an_arm_with_servos_and_a_force_sensor_presses_a_button() -> None:
    task = "press_button"
    compiled = library(shipped_tasks()[task])
    name = compiled.tasks[task].scene
    assert name is not None
    scene = catalogue.scene_path(name)
    prepared = prepare(compiled, task, scene)
    with toy_cell(scene.stem, state=prepared.assignment.state, patience=MUCH_PATIENCE) as (toy, cell):
        execution = execute_task(prepared, compiled, cell, [])
        assert execution.status == "succeeded", execution.failure
        assert cell.is_at_rest()
        found = toy.ask("report")
        assert found["violations"] == []
        assert found["commands"] > 100
