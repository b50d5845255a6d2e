"""An object is picked up and put down somewhere else, in simulation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.model import WorldModel

pytestmark = pytest.mark.sim

LAB = "http://example.org/lab#"
CONTAIN = "http://rvmi.aau.dk/ontologies/skiros.owl#contain"
TASK = """
prefix lab: <http://example.org/lab#>
import "handling.skill"

task tidy_up {
    scene "scene.ttl"
    do seq {
        Pick(arm: lab:Iiwa-1, object: lab:Eraser-1)
        Place(arm: lab:Iiwa-1, object: lab:Eraser-1, to: lab:Cell)
    }
}
"""
PLACING = """
lab:Cell skiros:hasA lab:Cell-placing .

lab:Cell-placing a skiros:PlacingPose ;
    skiros:FrameId "placing" ; skiros:BaseFrameId "map" ;
    skiros:PositionX 0.48 ; skiros:PositionY -0.45 ; skiros:PositionZ 0.704 ;
    skiros:OrientationW 0.0 ; skiros:OrientationX 1.0 ; skiros:OrientationY 0.0 ; skiros:OrientationZ 0.0 .
"""


def test_pick_and_place_moves_the_object_and_the_world_model_knows(tmp_path: Path) -> None:
    (tmp_path / "tidy.skill").write_text(TASK, encoding="utf-8")
    scene = tmp_path / "scene.ttl"
    scene.write_text(catalogue.scene_path("iiwa_table").read_text(encoding="utf-8") + PLACING, encoding="utf-8")
    outcome = libraries.compile_library(find_library(tmp_path))
    assert outcome.ok, outcome.diagnostics
    state = load_scene(scene, outcome.value.vocabulary)
    body = outcome.value.tasks["tidy_up"].body
    assert body is not None
    prepared = prepare_task(Assignment("tidy_up", state, ExecuteBody(body)), outcome.value)
    assert isinstance(prepared, PreparedTask), prepared
    cell = SimulatedCell(WorldModel(state))
    execution = execute_task(prepared, outcome.value, cell)
    assert execution.status == "succeeded", execution.failure
    after = cell.world.snapshot()
    assert after.holds(LAB + "Cell", CONTAIN, LAB + "Eraser-1")
    assert not after.holds(LAB + "Robotiq-1", CONTAIN, LAB + "Eraser-1")
    believed = pose(after, LAB + "Eraser-1").position
    tool = next(tool for tool in cell.scene.tools if tool.individual == LAB + "Eraser-1")
    really = cell.data.body(f"{cell.scene.names[tool.individual]}/block").xpos
    assert np.linalg.norm(believed - pose(state, LAB + "Eraser-1").position) > 0.05
    assert np.linalg.norm(believed - really) < 0.01
