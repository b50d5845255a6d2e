"""The story of a run says of each call what the tree says in the end, however it went, in bounded memory."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator

import msgspec
from hypothesis import HealthCheck, event, given, settings
from msgspec import structs

from skillc.services.recording.story_text import overview_lines
from skillc_dsl.position import Position
from skillc_model import tree
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import (
    Event,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    Note,
    PlanMade,
    Replanned,
    TaskEnded,
)
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.recording.history.history_builder import listen_to, read_history
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.recorded_plan import PlanStep
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledIri
from tree.library import FLAGS, ON, Library, act, check, here, par, seq, world
from tree.stage import PERIOD_S, Script, Stage
from tree.strategies import Play, plays
from why.stories import BEGIN, events_of, known, steps_of

LINE = Position("depot.skill", 5, 1)
EXAMPLES = int(os.environ.get("SKILLC_STORIES", "30"))
"""How many random runs are told; thousands on occasion."""


@given(plays())
@settings(max_examples=EXAMPLES, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_the_story_says_of_each_call_what_the_tree_says(play: Play) -> None:
    told: list[Event] = [BEGIN]
    stage = Stage(world(), play.scripts)
    engine = TreeRun(play.body, play.library, stage, (told.append,))
    for number in range(12):
        stage.now = number * PERIOD_S
        stage.world.commit([SetProperty(flag, ON, on) for tick, flag, on in play.switches if tick == number])
        if number == play.halt_at:
            engine.halt("the test says so")
        if engine.tick() is not Status.RUNNING:
            break
        assert shape(known(read_history(told)), engine.outcome) == shape_of(engine.outcome)
    story = known(read_history(told))
    assert shape(story, engine.outcome) == shape_of(engine.outcome)
    told_of = [link.message for link in story.chain]
    assert bool(told_of) == (engine.status is Status.FAILURE)
    event(f"{len(told) // 50 * 50} events, {engine.status.value}")


Shape = list[tuple[str, str, float | None, float | None, "Shape"]]


def shape(story: RunHistory, outcome: NodeOutcome) -> Shape:
    """Return the calls of a story that the tree still has, each at its last start."""
    there = {node.id for node in outcome.nodes()}

    def of(calls: Iterable[RecordedCall]) -> Shape:
        last = {each.node: each for each in calls if each.node in there}.values()
        return sorted((each.skill, each.status, each.started, each.ended, of(each.calls)) for each in last)

    return of(steps_of(story))


def shape_of(outcome: NodeOutcome) -> Shape:
    return sorted(
        (each.name.partition("[")[0], each.status, each.started, each.ended, shape_of_all(each.children))
        for each in calls_in(outcome)
    )


def shape_of_all(outcomes: tuple[NodeOutcome, ...]) -> Shape:
    return sorted(row for each in outcomes for row in shape_of(each))


def calls_in(outcome: NodeOutcome) -> Iterator[NodeOutcome]:
    if outcome.kind == "call":
        if outcome.status != "idle":
            yield outcome
        return
    for child in outcome.children:
        yield from calls_in(child)


def test_of_a_long_run_only_the_calls_of_earlier_rounds_stay() -> None:
    rounds = tree.Repeat(count=400, child=seq(act("a"), check(FLAGS[0]), act("b")), source=here())
    told = listen_to(events_of(rounds, Library().build(), Stage(world()), ticks=2000))
    (drawn,) = told.draw()
    kinds = Counter(node.kind for node in drawn.nodes())
    assert kinds["call"] == len(list(told.history.calls)) == 800
    assert kinds["check"] == 1, "that of the last round"
    assert len(told._records._last) < 10, "what may go on"


def test_each_round_of_a_loop_has_its_calls_in_order_of_time() -> None:
    cell = Stage(world(), {"a": [Script("fail"), Script("fail"), Script()]})
    retry = tree.Retry(count=5, child=seq(act("a"), act("b")), source=here())
    body = tree.Repeat(count=1, child=retry, source=here())
    steps = steps_of(known(read_history(events_of(body, Library().build(), cell))))
    assert [(each.number, each.status) for each in steps] == [
        ("1", "failure"),
        ("2", "failure"),
        ("3", "success"),
        ("4", "success"),
    ]
    rounds = [[(each.loop, each.number) for each in step.rounds] for step in steps]
    assert rounds == [[("repeat 1", 1), ("retry 5", number)] for number in (1, 2, 3, 3)]
    assert [step.failure.message if step.failure else "" for step in steps] == ["a failed", "a failed", "", ""]


def test_what_a_body_did_not_reach_is_no_success_and_comes_last() -> None:
    cell = Stage(world(), {"a": [Script(), Script("fail")]})
    first, second, other = act("a"), structs.replace(act("b"), source=LINE), structs.replace(act("c"), source=LINE)
    body = seq(tree.Repeat(count=2, child=seq(first, second), source=here()), other)
    told = [structs.replace(BEGIN, body=body), *events_of(body, Library().build(), cell)[1:]]
    steps = steps_of(known(read_history(told)))
    assert [step.status for step in steps] == ["success", "success", "failure"]
    unreached = structs.replace(other, source=Position("depot.skill", 9, 1))
    told[0] = structs.replace(BEGIN, body=seq(body, unreached))
    *_, last = steps_of(known(read_history(told)))
    assert (last.status, last.source, last.node) == ("not started", unreached.source, 0)


def test_steps_side_by_side_know_of_each_other() -> None:
    cell = Stage(world(), {"a": [Script(ticks=3)], "b": [Script(ticks=5)]})
    story = known(read_history(events_of(seq(par("all", act("a"), act("b")), act("c")), Library().build(), cell)))
    assert [(step.number, step.beside) for step in steps_of(story)] == [("1", ("2",)), ("2", ("1",)), ("3", ())]


A, B = LabelledIri("http://example.org/lab#a", "lab:a"), LabelledIri("http://example.org/lab#b", "lab:b")
GO = PlanStep(skill="Go", arguments={"to": B}, source=LINE)
STAY = PlanStep(skill="Go", arguments={"to": A}, source=LINE)


def planned(*events: Event) -> RunHistory:
    """Return the story of a plan to go to b and to a."""
    plan = PlanMade(time=0.0, planner="test", optimal="", cost=1.0, steps=(GO, STAY))
    return known(read_history([BEGIN, plan, *events]))


def node(number: int, parent: int, kind: str) -> NodeStarted:
    return NodeStarted(time=0.0, node=number, parent=parent, kind=kind, name="Go", source=LINE)


def ended(number: int, status: str = "success") -> NodeEnded:
    return NodeEnded(time=1.0, node=number, name="Go", status=status, source=LINE)


def chose(number: int, to: LabelledIri) -> ImplementationChosen:
    return ImplementationChosen(
        time=0.0, node=number, skill="Go", implementation="wheels", bindings={"to": to}, source=LINE
    )


def test_planned_steps_find_their_calls_by_their_arguments() -> None:
    story = planned(node(1, 0, "call"), chose(1, A), ended(1), node(2, 0, "call"), chose(2, B), ended(2))
    assert [step.bindings for step in steps_of(story)] == [{"to": B}, {"to": A}]


def test_a_step_whose_purpose_holds_is_skipped_and_one_that_was_not_reached_never_started() -> None:
    story = planned(node(1, 0, "if"), ended(1))
    assert [(step.status, step.bindings) for step in steps_of(story)] == [
        ("skipped", {"to": B}),
        ("not started", {"to": A}),
    ]


def test_plans_that_number_their_nodes_anew_are_told_apart() -> None:
    plan = PlanMade(time=2.0, planner="test", optimal="", cost=1.0, steps=(GO,))
    first = (node(1, 0, "call"), chose(1, B), ended(1, "failure"))
    again = (node(1, 0, "call"), chose(1, B), ended(1))
    story = planned(*first, Replanned(time=2.0, reason="stuck"), plan, *again)
    assert [(step.number, step.status) for step in steps_of(story)] == [
        ("1", "failure"),
        ("2", "not started"),
        ("3", "success"),
    ]
    assert [attempt.replaces for attempt in story.attempts] == ["", "stuck"]


def test_what_was_noted_is_told_with_the_plan_but_not_twice() -> None:
    claim = SpaceClaim(checked=0, steps=1, stopped="it goes on after an interruption")
    before, other = Note(time=0.0, message=f"the plan is {claim.summary}"), "the arm goes where nobody had looked"
    plan = PlanMade(time=0.0, planner="test", optimal="", cost=1.0, steps=(GO,), space=claim)
    run = (plan, before, node(1, 0, "call"), chose(1, B), Note(time=1.44, message=other), ended(1))
    story = known(read_history([BEGIN, *run]))
    assert [each.message for each in story.attempts[0].notes] == [before.message, other]
    lines = overview_lines(story)
    assert lines[lines.index("noted:") :][1] == f"  at 1.4 s: {other}"
    assert sum(claim.summary in each for each in lines) == 1
    quiet = known(read_history([BEGIN, *(each for each in run if not isinstance(each, Note))]))
    assert "noted:" not in overview_lines(quiet)


def test_a_recording_that_stops_has_no_status_and_says_what_ran() -> None:
    story = planned(node(1, 0, "call"), chose(1, B))
    assert story.status == "" and steps_of(story)[0].status == "running"


def test_the_end_of_a_task_is_that_of_its_story() -> None:
    failure = Failure(kind="plan", message="no way")
    story = planned(TaskEnded(time=3.0, task="play", status="failed", failure=failure))
    assert (story.status, story.failure, story.last) == ("failed", failure, 3.0)


def test_without_a_task_there_is_no_story() -> None:
    assert read_history([]) is None


def test_a_story_survives_json() -> None:
    story = planned(node(1, 0, "call"), chose(1, B), ended(1))
    assert msgspec.json.decode(msgspec.json.encode(story), type=RunHistory) == story
