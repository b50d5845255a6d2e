"""Shipped skills run through a control process on a robot of another process, and no command is beyond its limits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from backends.kinematic_runs import library, prepare, shipped_tasks
from control_process.toy_link import MUCH_PATIENCE, toy_cell
from skillc_ontology import catalogue
from skillc_runtime.execution.execute import execute_task

pytestmark = pytest.mark.robot


def run(task: str, check: Callable[[dict[str, Any]], None]) -> None:
    """Run a shipped task; check what the robot reports at the end."""
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
        check(found)


def test_an_arm_with_servos_and_a_force_sensor_presses_a_button() -> None:
    run("press_button", lambda found: None)


@pytest.mark.long
def test_an_arm_that_takes_torques_picks_a_peg_and_inserts_it() -> None:
    run("insert_peg_iiwa", lambda found: None)


def is_wiped(found: dict[str, Any]) -> None:
    assert min(found["coverage"].values()) > 0.99
    assert found["carries"] is not None


@pytest.mark.long
def test_an_arm_that_takes_torques_wipes_a_table() -> None:
    run("clean_table", is_wiped)
