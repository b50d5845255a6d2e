"""A task run in its loop: its states, the requests that each allows, and what it leaves behind."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from execution.loops import StagedCell, Watched, staged
from execution.ways import (
    EVERY,
    LONG,
    SHORT,
    WAYS,
    check_nothing_left,
    failed_step,
    paused,
    planned,
    running,
    turned,
)
from skillc_model import tree
from skillc_model.conditions import Individual, Literal, Not
from skillc_runtime.execution.task_state import ALLOWED, ALLOWED_AFTER_FAILURE
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import Note, Requested, TaskEnded, WorldChanged
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledIri, LabelledProperty, LabelledRelation
from tree.library import FLAGS, ON, Library, act, call, here, is_on, seq, with_
from tree.stage import Script


@dataclass(frozen=True)
class Seen:
    """What a refused request must not change."""

    state: str
    reason: str
    told: int
    log: tuple[object, ...]


def look(cell: StagedCell, watched: Watched) -> Seen:
    told = [event for event in watched.events if not isinstance(event, Requested)]
    return Seen(watched.run.state, watched.run.reason, len(told), tuple(cell.log))


@pytest.mark.parametrize("command", EVERY, ids=lambda each: each.name)
@pytest.mark.parametrize("state", WAYS)
def test_a_state_allows_what_its_table_says_and_a_refusal_changes_nothing(state: str, command: Command) -> None:
    cell, watched = WAYS[state]()
    run, before = watched.run, look(cell, watched)
    listed = ALLOWED_AFTER_FAILURE if state == "after failure" else ALLOWED[run.state]
    assert run.allowed == listed
    request = watched.loop.request(run, command)
    refused = request.refused = run.request(command, watched.loop.ticks)
    impossible = isinstance(command, commands.Replan | commands.Skip)  # not without a plan
    assert (refused is None) == (command.name in listed and not impossible)
    if refused is not None:
        assert look(cell, watched) == before
        why = "is refused: " if refused.why else f"is not possible while the task is {run.state}; "
        assert str(refused).startswith(f"`{command.name}` {why}")
    if not watched.told(TaskEnded):
        assert watched.told(Requested)[-1].refused == str(refused or "")


@pytest.mark.parametrize("state", WAYS)
def test_a_stop_ends_each_state_and_gives_everything_back(state: str) -> None:
    cell, watched = WAYS[state]()
    already_ended = watched.run.ended
    watched.loop.request(watched.run, commands.Stop("enough"))
    end = watched.until_end()
    assert end == ("succeeded" if already_ended else "stopped")
    if not already_ended:
        assert watched.run.failure is not None and watched.run.failure.message == "enough"
    check_nothing_left(cell, watched)


@pytest.mark.parametrize("state", WAYS)
def test_the_end_of_the_program_ends_each_state_at_once(state: str) -> None:
    cell, watched = WAYS[state]()
    begun, already_ended = bool(cell.starts), watched.run.ended
    watched.loop.close("the program ends")
    assert watched.run.end == ("succeeded" if already_ended else "stopped")
    assert watched.run.attempts or not begun, "what was begun is part of the result"
    assert bool(cell.secured) == begun
    check_nothing_left(cell, watched)
    watched.loop.close("the program ends")
    assert len(watched.told(TaskEnded)) == 1


@pytest.mark.parametrize("state", [each for each in WAYS if each not in ("queued", "planning", "succeeded")])
def test_the_deadline_ends_each_state_in_which_time_goes_on(state: str) -> None:
    cell, watched = WAYS[state]()
    watched.run.spec = RunSpec(deadline_s=1.0)
    ends = "stopped" if state == "stopping" else "failed"
    assert watched.until_end() == ends
    if ends == "failed":
        assert watched.run.failure is not None and watched.run.failure.kind == "timeout"
        assert watched.run.failure.message == "the task exceeded its deadline of 1 s"
        assert cell.now == pytest.approx(1.0, abs=0.03)
    check_nothing_left(cell, watched)


def test_a_task_ends_after_its_time_without_that_in_which_it_was_paused() -> None:
    cell, watched = staged(act("a"), within_s=1.0, a=LONG)
    watched.until("running").request(commands.PauseRun())
    watched.until("paused")
    for _ in range(300):
        watched.loop.tick()
    watched.request(commands.Resume())
    assert watched.until_end() == "failed" and watched.run.failure is not None
    assert watched.run.failure == Failure(kind="timeout", message="the task was not done within 1 s")
    assert 4.0 < cell.now < 4.5
    check_nothing_left(cell, watched)


@pytest.mark.parametrize(
    ("body", "name"),
    [
        (act("a"), "Scripted"),
        (tree.Wait(Literal(20.0), here()), "wait"),
        (tree.WaitUntil(Not(is_on(Individual(FLAGS[0]))), "not flag", here()), "wait until not flag"),
    ],
)
def test_a_step_ends_at_its_deadline_without_the_time_that_it_was_paused(body: tree.Node, name: str) -> None:
    cell, watched = staged(body, RunSpec(step_deadline_s=1.0), a=LONG)
    watched.until("running").request(commands.PauseRun())
    watched.until("paused")
    for _ in range(300):
        watched.loop.tick()
    watched.request(commands.Resume())
    assert watched.until_end() == "failed" and watched.run.failure is not None
    assert watched.run.failure.kind == "timeout"
    assert watched.run.failure.message == f"{name} was not done after 1 s, the deadline of each step"
    assert 4.0 < cell.now < 4.5
    check_nothing_left(cell, watched)


def test_each_step_has_the_time_of_a_deadline() -> None:
    slow = Script(ticks=80)
    body = seq(act("a"), tree.Wait(Literal(0.8), here()), act("b"))
    cell, watched = staged(body, RunSpec(step_deadline_s=1.0), a=slow, b=slow)
    assert watched.until_end() == "succeeded" and cell.now > 2.0


def test_a_run_is_prepared_while_time_stands_still_and_begins_at_once() -> None:
    cell, watched = staged(act("a"), looks=(50,), a=SHORT)
    for _ in range(50):
        watched.loop.tick()
        assert cell.now == 0.0 and watched.run.state == "planning"
    assert watched.until_end() == "succeeded"
    assert watched.states == ["planning", "running", "succeeded"]
    assert watched.loop.ticks == 6, "a tick for the start of planning, and five for the five of its primitive"


def test_a_plan_that_waits_for_approval_begins_when_it_is_approved() -> None:
    cell, watched = planned()
    for _ in range(20):
        watched.loop.tick()
    assert not cell.starts and watched.run.state == "planned"
    assert watched.request(commands.Approve()) is None
    assert cell.starts == {"a": 1}
    assert watched.states == ["planning", "planned", "queued", "running"]


def test_a_request_is_told_before_what_it_causes() -> None:
    _, watched = paused()
    watched.request(commands.Stop("enough"))
    watched.until_end()
    kinds = [type(event).__name__ for event in watched.events]
    assert kinds[kinds.index("Requested", kinds.index("Paused")) :] == [
        "Requested",
        "StateChanged",
        "NodeEnded",
        "NodeEnded",
        "TaskEnded",
    ]


def test_a_failed_step_waits_for_a_decision_while_time_goes_on() -> None:
    cell, watched = failed_step()
    assert watched.run.waits_for_decision and watched.run.reason == "a failed"
    before = cell.now
    assert watched.loop.tick() and cell.now > before
    cell.scripts["a"] = [SHORT]
    assert watched.request(commands.RetryStep()) is None
    assert watched.until_end() == "succeeded"
    assert cell.starts == {"a": 2} and len(watched.run.attempts) == 2


def test_a_body_that_was_not_planned_cannot_be_replanned_and_has_no_step_to_skip() -> None:
    _, watched = failed_step()
    skip = commands.Skip("done", who="me")
    for command, why in ((commands.Replan(), "only a goal"), (skip, "only a step of a plan")):
        refused = watched.request(command)
        assert refused is not None and why in str(refused) and watched.run.waits_for_decision


def test_a_world_edit_takes_effect_and_a_hold_that_it_breaks_is_found_after_the_pause() -> None:
    cell, watched = staged(call("Kept", name="a", flag=FLAGS[0]), a=LONG)
    watched.until("running").request(commands.PauseRun())
    watched.until("paused")
    assert watched.request(turned(FLAGS[0], False)) is None
    assert cell.world.snapshot().value(FLAGS[0], ON) is False
    for _ in range(10):
        watched.loop.tick()
    assert watched.run.state == "paused"
    watched.request(commands.Resume())
    assert watched.until_end() == "failed"
    assert watched.run.failure is not None and watched.run.failure.kind == "hold"


@pytest.mark.parametrize("state", ["planning", "running", "paused", "after failure", "stopping"])
def test_a_world_edit_is_told_once_in_each_state(state: str) -> None:
    cell, watched = WAYS[state]()
    assert watched.run.request(turned(FLAGS[1], False), watched.loop.ticks) is None
    (change,) = watched.told(WorldChanged)
    assert change.time == cell.now
    assert change.origin == "somebody: for the test"
    assert cell.world.snapshot().value(FLAGS[1], ON) is False


NOBODY = LabelledIri("http://example.org/stage#nobody", "nobody")


@pytest.mark.parametrize(
    "change",
    [
        LabelledProperty(NOBODY, LabelledIri(ON, "on"), True),
        LabelledProperty(LabelledIri(FLAGS[0], "flag0"), LabelledIri(ON, "on"), "a text"),
        LabelledProperty(LabelledIri(FLAGS[0], "flag0"), LabelledIri(ON + "x", "onx"), True),
        LabelledRelation(NOBODY, LabelledIri(ON + "x", "onx"), None),
        LabelledRelation(None, LabelledIri(ON, "on"), None),
    ],
    ids=str,
)
def test_a_world_edit_that_makes_no_sense_is_refused_with_the_reason(change: object) -> None:
    cell, watched = running()
    before = cell.world.snapshot()
    refused = watched.request(commands.EditWorld((change,), "by mistake", who="somebody"))  # type: ignore[arg-type]
    assert refused is not None and str(refused).startswith("`edit-world` is refused: ")
    assert cell.world.snapshot() is before and watched.run.state == "running"


def test_posts_are_applied_once_and_undone_once() -> None:
    library = Library()
    cell, watched = staged(call("Set", name="a", flag=FLAGS[0], value=False), library=library, a=SHORT)
    writes: list[object] = []
    cell.world.subscribe(writes.append)
    assert watched.until_end() == "succeeded"
    assert len(writes) == 1 and cell.world.snapshot().value(FLAGS[0], ON) is False


def test_a_listener_that_raises_is_removed_and_the_run_goes_on() -> None:
    _, watched = staged(act("a"), a=SHORT)

    def broken(event: object) -> None:
        raise RuntimeError("no space left")

    other = watched.loop.submit(watched.run.assignment, [broken, watched.events.append])
    assert watched.until_end() == "succeeded"
    while not other.ended:
        watched.loop.tick()
    assert other.end == "succeeded" and len(watched.told(TaskEnded)) == 2


@pytest.mark.parametrize("ending", ["crash", "exit", "crash at start"])
def test_code_that_crashes_fails_the_run_and_gives_everything_back(ending: str) -> None:
    cell, watched = staged(with_("scope", act("a")), a=Script(ending, ticks=3))  # type: ignore[arg-type]
    assert watched.until_end() == "failed"
    assert cell.said("release") == ["release scope"]
    check_nothing_left(cell, watched)


@pytest.mark.parametrize("state", [each for each in WAYS if each != "succeeded"])
@pytest.mark.parametrize("how", ["raises", "says so"])
def test_a_cell_that_breaks_ends_each_state(state: str, how: str) -> None:
    cell, watched = WAYS[state]()

    def break_down() -> None:
        cell.broken = "the line is dead"
        if how == "raises":
            raise OSError("the line is dead")

    if how == "says so" or not watched.run.needs_time:
        cell.broken = "the line is dead"
    else:
        cell.meanwhile = break_down
    assert watched.until_end() == ("stopped" if state == "stopping" else "failed")
    assert watched.run.failure is not None
    assert "the line is dead" in watched.run.failure.message or state == "stopping"
    check_nothing_left(cell, watched)


def test_what_was_not_in_order_at_the_end_is_told() -> None:
    cell, watched = running()
    cell.secure = lambda devices=None: ("the arm was left yielding",)  # type: ignore[method-assign]
    watched.loop.close("the program ends")
    assert [note.message for note in watched.told(Note)] == ["the arm was left yielding"]


def test_somebody_elses_change_does_not_disturb_a_run() -> None:
    cell, watched = running()
    cell.world.commit([SetProperty(FLAGS[2], ON, False)], "somebody else")
    assert watched.until_end() == "succeeded"
