"""What was done in a run has its figures and numbers in the report, whoever wrote the skill and however it ended."""

from __future__ import annotations

import json
import pickle
import re
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import pytest

from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.evaluation.report.result import PushResult, TaskResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.run_trace import RunTrace
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.table import list_table_rows
from skillc_runtime.evaluation.report.work import measure_work
from skillc_runtime.evaluation.report.work_figures import list_figures
from skillc_runtime.evaluation.report.write import write_report, write_result
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

LEAN = """
use skiros, rparts, cora, skillc, contact
import "motion.skill"
import "gripper.skill"
import "compliance.skill"
prefix lab: <http://example.org/lab#>

function in_front(fixture: Fixture) -> Pose = python "skillc_runtime.world.places:facing"

skill LeanOn {{
    in arm:     CompliantArm
    in gripper: GripperEffector
    in button:  Button
    noplan
}}

impl gently of LeanOn {{
    let before = offset(in_front(button), {before} * button.axis)

    do seq {{
        ActuateGripper(gripper, opening: 0 mm)
        MoveTo(arm, target: before)
        with Compliance(arm, along: button.axis, stiffness: 0 N/m) {{
            with Push(arm, along: button.axis, force: 4 N, travel: 3 cm) {{
                ActuateGripper(gripper, opening: 0 mm)
            }}
        }}
    }}
}}

task lean {{
    scene "scene.ttl"
    do LeanOn(arm: lab:Ur5e-1, gripper: lab:Wsg-1, button: lab:Button-1)
}}
"""
SVG = "{http://www.w3.org/2000/svg}"


@dataclass(frozen=True)
class Report:
    """The result of a run, the words of its page and of each of its figures."""

    result: TaskResult
    page: str
    written: dict[str, object]
    figures: dict[str, list[str]]


def run_and_report(folder: Path, before: str) -> Report:
    """Run a skill of its own in a kinematic cell, and write its report."""
    (folder / "lean.skill").write_text(LEAN.format(before=before))
    (folder / "scene.ttl").write_text(catalogue.scene_path("ur5e_button").read_text())
    outcome = libraries.compile_library(find_library(folder))
    assert outcome.ok, outcome.diagnostics
    state = load_scene(folder / "scene.ttl", outcome.value.vocabulary)
    body = outcome.value.tasks["lean"].body
    assert body is not None
    prepared = prepare_task(Assignment("lean", state, ExecuteBody(body)), outcome.value)
    assert isinstance(prepared, PreparedTask), prepared
    cell, told = KinematicCell(WorldModel(state)), HistoryBuilder()
    trace = RunTrace(cell)
    execution = execute_task(prepared, outcome.value, cell, [told], trace.sample)
    record = RunRecord(told.history, cell.world.snapshot(), cell.ground_truth, trace)
    result = summarise_run(execution, told.history, record.wipings, cell, measure_work(record))
    write_result(folder, result)
    write_report(folder, result, told.draw(), pickle.loads(pickle.dumps(list_figures(record))))
    figures = {path.stem: read_words(path) for path in folder.glob("*.svg")}
    written = json.loads((folder / "result.json").read_text())
    return Report(result, (folder / "report.html").read_text(), written, figures)


def read_words(path: Path) -> list[str]:
    """Return the texts of an SVG file."""
    return ["".join(each.itertext()).strip() for each in ElementTree.parse(path).iter(f"{SVG}text")]


@pytest.fixture(scope="module")
def leaning(tmp_path_factory: pytest.TempPathFactory) -> Report:
    """Return the report of a run that leans on a button."""
    return run_and_report(tmp_path_factory.mktemp("leaning"), before="2 cm")


def test_a_skill_of_ones_own_that_pushes_has_the_numbers_of_a_push(leaning: Report) -> None:
    (push,) = leaning.result.works
    assert isinstance(push, PushResult)
    assert (push.skill, str(push.arm), *map(str, push.on)) == ("LeanOn", "lab:Ur5e-1", "lab:Button-1")
    assert push.force_command_n == 4.0 and push.force_source == "sensor"
    assert push.contact_s is not None and push.start_s < push.contact_s < push.end_s
    assert push.force_mean_n == pytest.approx(push.true_mean_n, abs=0.5)
    assert push.true_mean_n is not None and 3.5 < push.true_mean_n < 6.0
    assert push.travel_mm is not None and push.travel_mm > 0.5


def test_its_figure_has_units_and_says_where_each_curve_comes_from(leaning: Report) -> None:
    words = leaning.figures["push"]
    assert {"Force over time", "Force over travel", "force, N", "time from the start of the push, s"} <= set(words)
    assert {"force: sensor", "force: commanded"} <= set(words)
    assert any(word.startswith("travel of the tool after contact, mm") for word in words)
    assert "Force of LeanOn on Button 1" in leaning.page
    assert "http://example.org" not in re.sub(r"<svg.*?</svg>", "", leaning.page, flags=re.DOTALL)


def test_the_numbers_of_the_report_are_those_of_the_result(leaning: Report) -> None:
    report = leaning
    (written,) = report.written["works"]  # type: ignore[misc]
    assert written["type"] == "push"
    (row,) = (value for name, value in list_table_rows(report.result) if name == "LeanOn lab:Button-1")
    for number in (f"{written['force_mean_n']:.1f} N mean", f"{written['force_greatest_n']:.1f} N greatest"):
        assert number in row
    assert f"<td>{row}</td>" in report.page


def test_a_push_that_touches_nothing_failed_and_still_has_its_figure(tmp_path: Path) -> None:
    report = run_and_report(tmp_path, before="10 cm")
    (push,) = report.result.works
    assert report.result.status == "failed" and isinstance(push, PushResult)
    assert (push.contact_s, push.force_mean_n, push.travel_mm) == (None, None, None)
    assert "nothing touched in" in report.page
    assert {"Force over time", "force: sensor"} <= set(report.figures["push"])
    assert "in contact" not in report.figures["push"]
