"""A run that is not ticked any more is stopped, fails when it wakes, and says so; so is one whose program ends."""

from __future__ import annotations

import numpy as np
import pytest

from safety import faults
from safety.test_faults import is_safe
from simulation.cells import ARM, SCENES, cell
from skillc_runtime.control.supervision.watchdog import HEARTBEAT_TIMEOUT_S, HeartbeatWatchdog
from skillc_runtime.execution import task_planning
from skillc_runtime.execution.assignment import NotStarted
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, TaskEnded
from skillc_runtime.recording.failure_text import describe_failure
from tree.library import call


def moving(scene: str) -> tuple[object, TreeRun, list[Event]]:
    """Return a cell whose arm circles on behalf of a run."""
    there, told = cell(scene), []
    run = TreeRun(call("Act", name=f"{scene} OverlayCircle"), faults.LIBRARY, there, (told.append,))
    for _ in range(20):
        run.tick()
        there.advance(0.01)
    return there, run, told


@pytest.mark.parametrize("scene", SCENES)
def test_when_the_tree_falls_silent_everything_stops(scene: str) -> None:
    there, run, told = moving(scene)
    arm = there.arm(ARM[scene])
    assert np.abs(arm.measured.velocity[:3]).max() > 1e-3
    there.advance(HEARTBEAT_TIMEOUT_S + 0.1)
    assert run.status is Status.RUNNING
    assert arm.fault == "the tree is not ticked any more"
    is_safe(there, scene)
    assert run.tick() is Status.FAILURE
    assert "the tree was not ticked for too long, so everything was stopped" in faults.reasons(told)


def test_a_paused_run_gives_signs_of_life_and_one_that_has_ended_needs_none() -> None:
    there, run, _ = moving("iiwa_table")
    arm = there.arm(ARM["iiwa_table"])
    run.pause()
    for _ in range(round(2 * HEARTBEAT_TIMEOUT_S / 0.01)):
        run.tick()
        there.advance(0.01)
    run.resume()
    assert run.tick() is Status.RUNNING
    run.halt("enough")
    there.advance(2 * HEARTBEAT_TIMEOUT_S)
    assert arm.fault is None


def test_each_who_falls_silent_is_told_once() -> None:
    dog = HeartbeatWatchdog(timeout_s=1.0)
    assert dog.beat("a", 0.0)
    assert dog.beat("b", 0.5)
    assert not dog.expired(1.0)
    assert dog.expired(1.2)
    assert not dog.expired(1.3)
    assert not dog.beat("a", 1.3)
    assert dog.beat("b", 1.3)
    dog.retire("a")
    assert dog.beat("a", 1.4)
    dog.retire("a")
    dog.retire("b")
    assert not dog.expired(9.0)


def test_a_program_that_ends_leaves_the_arm_safe() -> None:
    scene = "ur5e_whiteboard"
    there, told = cell(scene), []

    def watch() -> None:
        if there.now > 0.1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        execute_task(faults.prepared(there, scene, f"{scene} MoveLinear"), faults.LIBRARY, there, (told.append,), watch)
    assert "the program ends" in faults.reasons(told)
    is_safe(there, scene)


def test_a_planner_that_is_gone_when_a_new_plan_is_wanted_ends_the_task(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = "ur5e_whiteboard"
    there, told = cell(scene), []
    monkeypatch.setattr(task_planning, "replan_task", lambda *_, **_more: NotStarted("the planner does not start"))
    prepared = faults.reaching(there, scene, f"{scene} MoveLinear tick")
    execution = execute_task(prepared, faults.LIBRARY, there, (told.append,))
    assert execution.status == "failed"
    assert "broke at tick" in faults.reasons(told)
    (ended,) = (event for event in told if isinstance(event, TaskEnded))
    assert ended.failure is not None
    assert describe_failure(ended.failure).endswith("no other plan was found: the planner does not start")
    is_safe(there, scene)
