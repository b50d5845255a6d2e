"""What still falls when a task ends is judged where it comes to rest: a run has one verdict, wherever it runs."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from judging.test_claims import BIN, IN_BIN, LAB, PART, library, start
from judging.test_run import LIBRARY, SCENE, with_shipped_classes
from skillc.cli import main
from skillc_compiler.goals.parsing import parse_goal
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.events import Event, TaskEnded
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN

pytestmark = pytest.mark.slow

ABOVE_BIN, BESIDE_BIN = Pose.of((0.45, 0.15, 0.95)), Pose.of((0.45, 0.02, 0.95))

AT_THE_EDGE = ("0.45 ; skiros:PositionY -0.35", "0.193 ; skiros:PositionY -0.35")


def claims_at_the_end(falling_from: Pose) -> tuple[str, ...]:
    """Return the verdict of an operation that ends at once, while the part falls, of which the bin is claimed."""
    before = start().with_changes(placement_changes(PART, falling_from))
    cell, individuals = (
        SimulatedCell(WorldModel(before)),
        {each: sorted(before.types(each)) for each in before.individuals},
    )
    cell.world.commit([*placement_changes(PART, IN_BIN), AddRelation(BIN, CONTAIN, PART)])
    goal = parse_goal("lab:Bin-A contain lab:Part-A", library().vocabulary, individuals, {"lab": LAB}).value
    assert goal is not None
    prepared = prepare_task(Assignment("put", cell.world.snapshot(), AchieveGoal(goal)), library())
    assert isinstance(prepared, PreparedTask)
    events = list[Event]()
    assert execute_task(prepared, library(), cell, [events.append]).status == "succeeded"
    (ended,) = (each for each in events if isinstance(each, TaskEnded))
    return ended.false_claims


def test_a_part_that_falls_into_the_bin_is_in_it() -> None:
    assert claims_at_the_end(ABOVE_BIN) == ()


def test_a_part_that_falls_beside_the_bin_is_not_in_it() -> None:
    (claim,) = claims_at_the_end(BESIDE_BIN)
    assert claim.startswith("lab:Part-A is claimed in lab:Bin-A but lies on lab:Table")


def test_a_part_that_falls_off_the_table_after_the_task_has_ended_makes_it_a_false_success(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The claim is the same in the recording, in the result and in the exit code, and a replay repeats it."""
    monkeypatch.chdir(tmp_path)
    scene = with_shipped_classes(SCENE.read_text("utf-8")).replace(*AT_THE_EDGE)
    (tmp_path / "cell.ttl").write_text(scene, "utf-8")
    (tmp_path / "put.skill").write_text(LIBRARY, "utf-8")
    words = ["run", "put.skill:nothing", "--quiet", "--no-film", "--tick-timeout", "0", "--out", "out"]
    ended = CliRunner().invoke(main.skillc, words, catch_exceptions=False)
    assert ended.exit_code == 3, ended.output
    (claim,) = json.loads((tmp_path / "out" / "result.json").read_text("utf-8"))["false_claims"]
    assert claim == "lab:Part-A is claimed at 0.19 -0.35 0.63 but lies on the floor, 0.62 m away"
    lines = (tmp_path / "out" / "events.jsonl").read_text("utf-8").splitlines()
    recorded = [each["event"] for each in map(json.loads, lines) if "event" in each]
    assert [each["false_claims"] for each in recorded if each["type"] == "task-ended"] == [[claim]]
    checked = CliRunner().invoke(main.skillc, ["replay", "--check", "out"], catch_exceptions=False)
    assert checked.exit_code == 0, checked.output
