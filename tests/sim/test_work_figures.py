"""Work in contact, simulated with physics, has figures and numbers that agree with what the simulator knows."""

from __future__ import annotations

import pickle

import pytest

from backends.kinematic_runs import library, prepare
from skillc_ontology import catalogue
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report.figure import render_figure
from skillc_runtime.evaluation.report.result import GraspResult, GuidanceResult, PushResult, SearchResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.run_trace import RunTrace
from skillc_runtime.evaluation.report.work import measure_work
from skillc_runtime.evaluation.report.work_figures import list_figures
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.world.state.model import WorldModel

pytestmark = pytest.mark.sim


def run(task: str, scene: str) -> RunRecord:
    """Run a task of the contact skills with physics."""
    compiled = library("contact")
    prepared = prepare(compiled, task, catalogue.scene_path(scene))
    cell, told = SimulatedCell(WorldModel(prepared.assignment.state), seed=0), HistoryBuilder()
    trace = RunTrace(cell)
    execution = execute_task(prepared, compiled, cell, [told], trace.sample)
    assert not execution.failure, execution.failure
    return RunRecord(told.history, cell.world.snapshot(), cell.ground_truth, trace)


def test_an_insertion_has_its_push_search_and_grasp() -> None:
    record = run("insert_peg", "panda_peg")
    push, search, grasp = measure_work(record)
    assert isinstance(push, PushResult) and isinstance(search, SearchResult) and isinstance(grasp, GraspResult)
    assert push.force_source == "estimate" and push.force_command_n == 8.0
    assert push.true_greatest_n is not None and push.true_greatest_n >= 8.0
    assert tuple(map(str, search.on)) == ("lab:Peg-1", "lab:Socket-1")
    assert search.found_mm is not None and 0.0 < search.found_mm <= search.radius_mm + 0.1 < 9.0
    assert search.depth_mm == pytest.approx(30.0, abs=2.0)
    assert grasp.force_n == pytest.approx(40.0, abs=1.0)
    (figure,) = list_figures(record)
    svg = render_figure(pickle.loads(pickle.dumps(figure)).draw).svg.decode()
    for words in ("path: commanded", "path of the tool: estimate", "hole: simulator truth", "force: simulator truth"):
        assert f">{words}</text>" in svg
    assert figure.draw().axes[0].get_aspect() == 1.0


def test_an_arm_that_is_led_has_the_path_and_the_force_of_the_person() -> None:
    record = run("teach_pose", "iiwa_guiding")
    (guided,) = measure_work(record)
    assert isinstance(guided, GuidanceResult) and str(guided.arm) == "lab:Iiwa-1"
    assert guided.path_mm >= guided.moved_mm - 1e-6 > 100.0
    (person,) = record.truth.guidances()
    assert guided.person_greatest_n == pytest.approx(float(person.forces.max()))
    (figure,) = list_figures(record)
    svg = render_figure(pickle.loads(pickle.dumps(figure)).draw).svg.decode()
    for words in ("path of the tool: estimate", "force of the person: simulator truth", "intended by the person"):
        assert f">{words}</text>" in svg
