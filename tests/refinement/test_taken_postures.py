"""Runs take the postures with which their plans were looked at, and say where these do not fit any more."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from msgspec import structs

from refinement.scenes import write_door
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.trials.experiment import TrialRunner
from skillc_runtime.execution.assignment import PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.recording.events import Event, Note
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.recording.space_claim import ChosenPosture
from skillc_runtime.world.state.model import WorldModel

GOAL = RunSpec(library="wiping", goal="lab:Desk-1.isClean == true")
BODY = """
prefix lab: <http://example.org/lab#>
import "handling.skill"
import "wiping/wipe.skill"

task wipe_door {
    scene "door.ttl"
    do seq {
        Pick(arm: lab:Panda-1, object: lab:Eraser-1)
        Wipe(surface: lab:Desk-1, arm: lab:Panda-1)
    }
}
"""
CLEAN = """
use wiping
prefix lab: <http://example.org/lab#>
import "handling.skill"
import "wiping/wipe.skill"

task clean_door {
    scene "door.ttl"
    goal  lab:Desk-1.isClean == true
}
"""


def wipe_door(
    folder: Path,
    change: Callable[[ChosenPosture], ChosenPosture | None] = lambda each: each,
    physics: bool = False,
    body: bool = False,
) -> tuple[str, str, list[str]]:
    """Wipe a door on which not all lanes go from the posture nearest to home; return how it ends, why, and the notes.

    The run takes the postures of the plan, or of a body that was given, after a change of each, which may drop it.
    """
    scene, events = write_door(folder, 0.5, -20.0, 0.75), list[Event]()
    (folder / "tasks.skill").write_text(BODY)
    spec = RunSpec(task=f"{folder}:wipe_door") if body else structs.replace(GOAL, scene=str(scene))
    with load_task(spec, SilentReporter()) as task:
        prepared = prepare_task(task.assignment, task.library, look=SpaceLook())
        assert isinstance(prepared, PreparedTask) and prepared.space is not None
        postures = tuple(filter(None, map(change, prepared.space.postures)))
        prepared = structs.replace(prepared, space=structs.replace(prepared.space, postures=postures))
        world = WorldModel(task.assignment.state)
        ended = execute_task(
            prepared, task.library, SimulatedCell(world) if physics else KinematicCell(world), [events.append]
        )
    notes = [each.message for each in events if isinstance(each, Note)]
    return ended.status, "" if ended.failure is None else ended.failure.message, notes


@pytest.mark.slow
@pytest.mark.parametrize("body", [False, True])
def test_a_surface_does_not_go_from_the_posture_nearest_to_home(tmp_path: Path, body: bool) -> None:
    status, why, notes = wipe_door(tmp_path, lambda each: None, body=body)
    assert (status, notes) == ("failed", [])
    assert "the joint joint4 would have to be at -3." in why


@pytest.mark.slow
def test_it_is_wiped_from_another_one_by_a_body(tmp_path: Path) -> None:
    assert wipe_door(tmp_path, body=True) == ("succeeded", "", [])


@pytest.mark.sim
def test_it_is_wiped_with_force_by_a_plan(tmp_path: Path) -> None:
    assert wipe_door(tmp_path, physics=True) == ("succeeded", "", [])


@pytest.mark.slow
def test_where_a_thing_is_elsewhere_the_posture_nearest_to_home_is_taken_and_that_is_told(tmp_path: Path) -> None:
    def shift(each: ChosenPosture) -> ChosenPosture:
        x, y, z = each.tool.position_m
        return structs.replace(each, tool=structs.replace(each.tool, position_m=(x, y + 0.1, z)))

    status, _, notes = wipe_door(tmp_path, shift)
    assert status == "failed"
    assert notes[0].startswith("lab:Panda-1 goes where nobody had looked, 0.10 m and 0 degrees from where")


@pytest.mark.slow
def test_a_posture_that_does_not_fit_any_more_is_not_taken_and_that_is_told(tmp_path: Path) -> None:
    def turn(each: ChosenPosture) -> ChosenPosture:
        return structs.replace(each, q=(*each.q[:6], each.q[6] + 1.0)) if each.step == 1 else each

    status, _, notes = wipe_door(tmp_path, turn)
    assert status == "succeeded"
    assert [each.startswith("lab:Panda-1 takes another posture than was planned") for each in notes] == [True]


@pytest.mark.sim
def test_a_trial_takes_another_posture_where_a_surface_is_elsewhere(tmp_path: Path) -> None:
    """As a run does: it was planned again as if nobody could look, and no trial of five wiped anything."""
    write_door(tmp_path, 0.5, -20.0, 0.75)
    (tmp_path / "tasks.skill").write_text(CLEAN)
    with load_task(RunSpec(task=f"{tmp_path}:clean_door"), SilentReporter()) as task:
        trial = TrialRunner(task.library, task.assignment.state, "clean_door", "none").run(0)
    assert (trial.status, trial.coverage, trial.verified) == ("succeeded", 1.0, True)
