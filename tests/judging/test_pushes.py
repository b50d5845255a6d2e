"""With which force an arm pushed is asked of the calls that a success rests on, not of one that failed before."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.guarded_push import MeasuredForce
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.primitives.push_force import write_push_force
from skillc_runtime.recording.known_facts import format_unverified
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

LIBRARY = """
prefix lab: <http://example.org/lab#>
use skiros, skillc, rparts, contact

skill Press {
    in   arm:    ArmDevice
    in   button: Button
    post button.isOn == true
    FALLBACK
}

impl hard of Press {
    prefer 1
    run python "judging.test_pushes:PressTooHard"
}

impl right of Press {
    run python "judging.test_pushes:Press"
}

skill Lean {
    in arm:    ArmDevice
    in button: Button
}

impl loosely of Lean {
    run python "judging.test_pushes:Lean"
}

task switch_on {
    scene "ur5e_button"
    goal lab:Button-1.isOn == true
}

task lean_and_press {
    scene "ur5e_button"
    do seq {
        Lean(arm: lab:Ur5e-1, button: lab:Button-1)
        Press(arm: lab:Ur5e-1, button: lab:Button-1)
    }
}
"""


class Press(Primitive):
    """Pushes with 10 N, and measures `measured`."""

    moves = NOTHING
    measured = MeasuredForce(0.0, 10.0)

    def __init__(self, cell: Cell, *, arm: str, button: str) -> None:
        super().__init__(cell)
        self._arm, self._button = arm, button

    def start(self) -> None:
        """Push."""
        write_push_force(self.cell.world, self._arm, 10.0, self.measured)

    def tick(self) -> Status:
        """Return SUCCESS."""
        return Status.SUCCESS


class Lean(Press):
    """Pushes too hard, which nothing asks for."""

    measured = MeasuredForce(0.0, 12.0)


class PressTooHard(Lean):
    """Pushes too hard, and fails."""

    def tick(self) -> Status:
        """SkillFailure."""
        raise SkillFailure("the button is stuck")


def find_forces(task: str, folder: Path, fallback: str = "") -> tuple[int, list[str]]:
    """Return in how many attempts a task succeeded, and with which forces."""
    (folder / "press.skill").write_text(LIBRARY.replace("FALLBACK", fallback), "utf-8")
    outcome = libraries.compile_library(find_library(folder))
    assert outcome.ok, outcome.diagnostics
    state, found = load_scene(catalogue.scene_path("ur5e_button"), outcome.value.vocabulary), outcome.value.tasks[task]
    by_goal = None if found.goal is None else AchieveGoal(found.goal)
    objective = by_goal if found.body is None else ExecuteBody(found.body)
    assert objective is not None
    prepared = prepare_task(Assignment(task, state, objective), outcome.value)
    assert isinstance(prepared, PreparedTask), prepared
    ended = execute_task(prepared, outcome.value, KinematicCell(WorldModel(state)))
    assert ended.status == "succeeded", ended.failure
    return len(ended.attempts), [each for each in map(format_unverified, ended.facts) if "pushForce" in each]


@pytest.mark.parametrize("fallback", ["", "fallback"])
def test_a_push_of_what_failed_and_was_done_again_does_not_count(fallback: str, tmp_path: Path) -> None:
    attempts, (force,) = find_forces("switch_on", tmp_path, fallback)
    assert (attempts == 1) == bool(fallback), "the task is tried again where no other implementation takes over"
    assert force.startswith("lab:Ur5e-1.pushForce == 10 N is only idealised")


def test_the_worst_of_the_pushes_that_succeeded_counts(tmp_path: Path) -> None:
    _, (force,) = find_forces("lean_and_press", tmp_path, "fallback")
    assert force.startswith("lab:Ur5e-1.pushForce == 10 N is only assumed: the arm measured 12.00 N for 10 N")
