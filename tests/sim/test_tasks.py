"""Whole tasks in simulation that are interrupted leave the arm safe, and repeat themselves; trials judge whole ones."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from skillc.services.library import libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.numerics.compiled import COMPILES
from skillc_runtime.recording.events import Event, ImplementationChosen
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel
from waiting import LONG_S

pytestmark = pytest.mark.sim

LAB = "http://example.org/lab#"
TASKS = ("clean_whiteboard", "clean_table", "clean_desk")
ARMS = {"clean_whiteboard": LAB + "Ur5e-1", "clean_table": LAB + "Iiwa-1", "clean_desk": LAB + "Panda-1"}


@cache
def library() -> SkillLibrary:
    outcome = libraries.compile_library(find_library(SHIPPED / "wiping"))
    assert outcome.ok
    return outcome.value


def start(name: str, seed: int) -> tuple[PreparedTask, SimulatedCell]:
    task = library().tasks[name]
    assert task.scene is not None
    assert task.goal is not None
    state = load_scene(catalogue.scene_path(task.scene), library().vocabulary)
    prepared = prepare_task(Assignment(name, state, AchieveGoal(task.goal)), library())
    assert isinstance(prepared, PreparedTask), prepared
    return prepared, SimulatedCell(WorldModel(state), seed)


def at_rest(execution: Execution, arm: str) -> bool:
    """Whether an arm neither moves nor is asked to push, and is stiff along every axis."""
    driver = execution.backend.arm(arm)
    pushes = abs(driver.compliance.commanded_wrench).max() > 0.1
    return (
        not pushes
        and bool((driver.compliance.commanded_stiffness[:3] > 0).all())
        and abs(driver.measured.velocity).max() < 0.02
    )


@pytest.mark.parametrize("name", TASKS)
def test_interrupted_while_wiping_it_lets_go_and_is_stiff_again(name: str) -> None:
    prepared, cell = start(name, 0)
    followed: list[float] = []
    pushed: list[bool] = []

    def listen(event: Event) -> None:
        if isinstance(event, ImplementationChosen) and event.skill == "FollowPath":
            followed.append(event.time)

    def interrupted() -> bool:
        if followed and cell.now > followed[-1] + 1.0:
            pushed.append(abs(cell.arm(ARMS[name]).compliance.commanded_wrench).max() > 1.0)
            return True
        return False

    execution = execute_task(prepared, library(), cell, [listen], interrupted=interrupted)
    assert pushed == [True]
    assert execution.status == "stopped"
    assert at_rest(execution, ARMS[name])


def test_interrupted_while_driving_the_base_comes_to_rest() -> None:
    prepared, cell = start("clean_whiteboard", 0)
    moving: list[bool] = []

    def interrupted() -> bool:
        if cell.now > 2.0:
            moving.append(cell.is_at_rest())
            return True
        return False

    execution = execute_task(prepared, library(), cell, interrupted=interrupted)
    assert moving == [False]
    assert execution.status == "stopped"
    assert cell.is_at_rest()


def test_the_same_seed_gives_the_same_run() -> None:
    recordings = []
    for _ in range(2):
        prepared, cell = start("clean_table", 3)
        execute_task(prepared, library(), cell, interrupted=lambda now=cell: now.now > 8.0)  # type: ignore[misc]
        recordings.append(cell.ground_truth.recording("http://example.org/lab#Eraser-1").rows.tobytes())
    assert recordings[0] == recordings[1]
    assert recordings[0]


def test_ctrl_c_halts_reports_and_exits_with_3(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "skillc", "run", "clean_table", "--json", "--no-film", "--out", str(tmp_path)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONUNBUFFERED": "1"})
    events = tmp_path / "events.jsonl"
    try:
        while process.poll() is None and not (events.exists() and "Grasp" in events.read_text(encoding="utf-8")):
            time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=LONG_S)
    finally:
        process.kill()
    result = json.loads(output)
    assert process.returncode == 3
    assert result["status"] == "stopped"
    assert "interrupted" in result["failure"]
    assert (tmp_path / "report.html").is_file()


@pytest.mark.skipif(not COMPILES, reason="nothing is compiled here")
@pytest.mark.parametrize("name", ["clean_table", "clean_whiteboard"])
def test_a_wipe_is_the_same_to_the_last_bit_whether_machine_code_or_python_runs_its_steps(name: str) -> None:
    ends = []
    for by_program in (True, False):
        prepared, cell = start(name, 0)
        cell.steps.runs_program = by_program
        assert execute_task(prepared, library(), cell).status == "succeeded"
        ends.append((cell, cell.world.snapshot()))
    (one, world), (other, same_world) = ends
    assert one.now == other.now and list(world.facts) == list(same_world.facts)
    np.testing.assert_array_equal(one.data.qpos, other.data.qpos)
    for tool in one.scene.tools:
        here, there = (each.ground_truth.recording(tool.individual).rows for each in (one, other))
        assert len(here) > 1000
        np.testing.assert_array_equal(here, there)
    for surface in one.scene.surfaces:
        here, there = (each.ground_truth.coverage(surface.individual).dose for each in (one, other))
        np.testing.assert_array_equal(here, there)
