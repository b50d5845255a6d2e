"""Pausing in contact, as whole tasks meet it: on three arms, in each phase, with force kept or the tool taken off."""

from __future__ import annotations

import numpy as np
import pytest
from contact_runs import LAB, at_rest
from contact_runs import library as contact
from paused_runs import PausedRun
from test_tasks import library as wiping

from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.trials.targets import WIPING
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.recording.commands import Stop

pytestmark = pytest.mark.sim

ARMS = ("clean_table", "clean_whiteboard", "clean_desk")
KEEP_S, LIFTING_S = 2.0, 1.2
STILL_M, RELAXED_M = 5e-4, 3e-3
"""How far a tool that is still moves at most; on a surface, friction and a soft tool relax for a while."""


def missed_targets(result: WipingResult) -> list[str]:
    """The targets of trials that a wiping does not meet."""
    values = ((metric, metric.of(result)) for metric in WIPING)
    return [f"{metric.name}: {value:g}" for metric, value in values if value is not None and not metric.is_met(value)]


def test_in_a_short_pause_of_wiping_the_force_is_kept() -> None:
    paused = PausedRun("FollowPath", after_s=3.0, lasts_s=1.5).start(wiping(), "clean_desk", 3)
    assert paused.run.state == "succeeded", paused.run.failure
    result = paused.wiping()
    still_at = paused.still[0][0]
    kept = paused.forces(still_at, paused.resumed_at) / result.force_command_n
    assert len(kept) > 300 and np.abs(kept - 1).max() < 0.1
    assert paused.moved_m(still_at, paused.resumed_at) < RELAXED_M
    assert missed_targets(result) == []
    assert at_rest(paused.cell)


@pytest.mark.parametrize("task", ARMS)
def test_in_a_long_pause_of_wiping_the_tool_is_taken_off_and_touches_again(task: str) -> None:
    paused = PausedRun("FollowPath", after_s=3.0, lasts_s=10.0).start(wiping(), task, 7)
    assert paused.run.state == "succeeded", paused.run.failure
    result, (began, ended) = paused.wiping(), paused.paused
    assert paused.forces(began, began + KEEP_S).min() > 0.8 * result.force_command_n
    off = paused.forces(began + KEEP_S + LIFTING_S, paused.resumed_at)
    assert len(off) > 6000 and not off.any()
    assert paused.moved_m(began + KEEP_S + LIFTING_S, paused.resumed_at) < STILL_M
    assert paused.contacts == ["none", "kept", "lifting", "taken-off", "approaching", "none"]
    touching = paused.forces(paused.resumed_at, ended)
    assert touching[-1] > 0.9 * result.force_command_n and touching.max() < 2 * result.force_command_n
    assert missed_targets(result) == []
    assert at_rest(paused.cell)


def test_a_pause_before_the_lanes_does_not_spoil_the_wiping() -> None:
    paused = PausedRun("Align", after_s=0.3, lasts_s=8.0).start(wiping(), "clean_table", 7)
    assert paused.run.state == "succeeded", paused.run.failure
    assert missed_targets(paused.wiping()) == []
    assert at_rest(paused.cell)


def test_a_tool_that_approaches_is_stopped_above_the_surface() -> None:
    paused = PausedRun("Push", after_s=0.5, lasts_s=8.0).start(wiping(), "clean_table", 7)
    assert paused.run.state == "succeeded", paused.run.failure
    still_at = paused.still[0][0]
    assert not paused.forces(paused.paused[0], paused.resumed_at).any()
    assert paused.contacts == ["none"]
    assert paused.moved_m(still_at, paused.resumed_at) < STILL_M
    assert missed_targets(paused.wiping()) == []


def test_polishing_goes_on_with_its_swing() -> None:
    paused = PausedRun("FollowPath", 4.0, lasts_s=8.0).start(contact(), "polish_sheet", 0)
    assert paused.run.state == "succeeded", paused.run.failure
    share = paused.cell.world.snapshot().value(LAB + "Sheet-1", "https://w3id.org/skillc/contact#polishedShare")
    assert isinstance(share, float) and share >= 0.99
    targets = [each for each in missed_targets(paused.wiping()) if not each.startswith("coverage")]
    assert targets == []
    assert at_rest(paused.cell)


def test_a_search_goes_on_where_it_was() -> None:
    paused = PausedRun("SinkBelow", 3.0, lasts_s=8.0).start(contact(), "insert_peg_iiwa", 1)
    assert paused.run.state == "succeeded", paused.run.failure
    assert paused.cell.ground_truth.recording(LAB + "Peg-1").force.max() < 40.0
    assert at_rest(paused.cell)


def test_a_tool_that_is_guided_is_held_while_paused() -> None:
    paused = PausedRun("AwaitGuidance", 1.0, 8.0).start(contact(), "teach_pose", 3)
    assert paused.run.state == "succeeded", paused.run.failure
    assert paused.moved_m(paused.still[0][0] + 0.5, paused.resumed_at) < 10 * STILL_M


@pytest.mark.parametrize(("task", "lasts_s"), [("clean_table", 6.0), ("clean_whiteboard", 2.3)])
def test_stopped_in_a_pause_the_arm_lets_go_and_is_stiff(task: str, lasts_s: float) -> None:
    paused = PausedRun("FollowPath", 3.0, lasts_s, Stop("enough")).start(wiping(), task, 0)
    assert paused.run.state == "stopped"
    assert at_rest(paused.cell)
    (tool,) = paused.cell.scene.tools
    before = paused.cell.ground_truth.face_position(tool.individual)
    paused.cell.advance(2.0)
    assert np.abs(paused.cell.ground_truth.face_position(tool.individual) - before).max() < 10 * STILL_M


def test_an_arm_that_stops_by_itself_in_a_pause_fails_the_run() -> None:
    paused = FaultyPause("FollowPath", 3.0, lasts_s=5.0).start(wiping(), "clean_table", 0)
    assert paused.run.state == "failed"
    assert paused.run.failure is not None and paused.run.failure.message == "the test breaks the arm"
    assert at_rest(paused.cell)


class FaultyPause(PausedRun):
    """A pause at whose end the arm stops by itself; nobody resumes."""

    def act(self, loop: CellLoop) -> None:
        self.cell.arm(LAB + "Iiwa-1").abort("the test breaks the arm")
