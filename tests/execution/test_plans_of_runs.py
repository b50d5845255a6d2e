"""Plans that are outdated when they arrive, that wait for approval, or whose steps fail and wait for a decision."""

from __future__ import annotations

import pytest

from execution.loops import Watched
from execution.yard import CRATE_TO_B, Yard
from plans.depot import contain, iri, library
from skillc_runtime.execution.conclusion import MAX_ATTEMPTS
from skillc_runtime.recording import commands
from skillc_runtime.recording.events import PlanArrived, Replanned, WorldChanged
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.changes import RemoveRelation
from skillc_runtime.world.state.labels.labelling import label_change

ASKING = RunSpec(ask_after_failure=True)


def test_a_plan_that_the_world_has_outrun_is_made_again() -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B, looks=(5,))
    yard.tick(3)
    yard.move("crate", "a", "d")
    assert run.until_end() == "succeeded"
    assert yard.depot.log[0] == "carl c d" and len(run.told(PlanArrived)) == 2
    assert not run.told(Replanned), "nothing was begun before"


def test_a_world_that_never_rests_ends_the_planning() -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B, looks=(2, 1, 1, 1, 1))
    for number in range(20):
        yard.tick(1)
        yard.move("crate", "acd"[number % 3], "acd"[(number + 1) % 3])
    assert run.run.end == "failed" and run.run.failure is not None
    assert run.run.failure.message.startswith(f"the world changed {MAX_ATTEMPTS} times so that a plan no longer worked")
    assert not yard.depot.log


def test_a_plan_that_waits_for_approval_is_checked_again_when_it_begins() -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B, RunSpec(approve=True)).until("planned")
    yard.move("crate", "a", "d")
    run.request(commands.Approve())
    run.until("planned")
    run.request(commands.Approve())
    assert run.until_end() == "succeeded" and yard.depot.log[0] == "carl c d"


def test_a_planned_task_is_planned_again_on_request() -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B, RunSpec(approve=True)).until("planned")
    assert run.request(commands.Replan()) is None
    assert run.until("planned").told(PlanArrived)[1].plan == run.told(PlanArrived)[0].plan
    assert len(run.told(PlanArrived)) == 2


def broken_step(step: str) -> tuple[Yard, Watched]:
    """Return a yard in which a step failed the first time, and the run, which waits for a decision."""
    yard = Yard({"carl": "c"}, {"crate": "a"}, fails=lambda name, number: name == step and number == 1)
    return yard, yard.submit(CRATE_TO_B, ASKING).until("paused", 4000)


def test_a_failed_step_of_a_plan_is_retried_with_the_steps_after_it() -> None:
    yard, run = broken_step("carl crate a")
    assert run.request(commands.RetryStep()) is None
    assert run.until_end() == "succeeded"
    assert yard.depot.log == ["carl c a", "carl crate a", "carl crate a", "carl a b", "carl crate b"]


@pytest.mark.parametrize("step", ["carl crate a", "carl crate b"], ids=["in the middle", "the last"])
def test_a_failed_step_that_somebody_has_done_is_skipped_with_its_effects_assumed(step: str) -> None:
    yard, run = broken_step(step)
    assert run.request(commands.Skip("put it there by hand", who="Ann")) is None
    (skipped,) = [event for event in run.told(WorldChanged) if event.origin.startswith("Ann")]
    assert skipped.origin == "Ann: put it there by hand" and skipped.known == "assumed"
    assert run.until_end() == "succeeded" and run.run.verified is False
    assert yard.depot.log.count(step) == 1
    assert yard.depot.world.snapshot().holds(iri("b"), contain("b", "crate").relation, iri("crate"))


def test_after_a_failure_another_plan_can_be_made() -> None:
    _, run = broken_step("carl crate b")
    assert run.request(commands.Replan()) is None
    assert run.until_end() == "succeeded"
    assert len(run.told(Replanned)) == 1


def test_a_retry_that_is_no_longer_possible_is_refused_and_replanning_is_not() -> None:
    yard, run = broken_step("carl crate a")
    yard.move("crate", "a", "d")
    refused = run.request(commands.RetryStep())
    assert refused is not None and "`from contain crate` does not hold" in refused.why and run.run.waits_for_decision
    assert run.request(commands.Replan()) is None and run.until_end() == "succeeded"


@pytest.mark.parametrize("state", ["running", "paused"])
def test_a_paused_run_can_be_replanned_and_a_running_one_only_once_it_is_paused(state: str) -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B)
    yard.tick(30)
    if state == "running":
        assert run.request(commands.Replan()) is not None
    run.request(commands.PauseRun())
    run.until("paused")
    assert run.request(commands.Replan()) is None
    assert run.until_end() == "succeeded"
    assert [event.reason for event in run.told(Replanned)] == [
        "the plan no longer leads to the goal: another plan was requested"
    ]


def test_a_plan_that_no_longer_leads_to_the_goal_is_replaced_while_paused() -> None:
    yard = Yard({"carl": "c"}, {"crate": "a"})
    run = yard.submit(CRATE_TO_B)
    yard.tick(30)
    run.request(commands.PauseRun())
    run.until("paused")
    there = contain("d", "crate")
    gone = RemoveRelation(iri("a"), there.relation, iri("crate"))
    changes = tuple(label_change(each, library().vocabulary) for each in (gone, there))
    assert run.request(commands.EditWorld(changes, "moved it", who="Ann")) is None
    run.until("planning").until("paused").request(commands.Resume())
    assert run.until_end() == "succeeded" and "carl crate d" in yard.depot.log
