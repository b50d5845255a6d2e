"""Events, their file, and the tree with its outcomes."""

from __future__ import annotations

import builtins
import types
import typing
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, get_args, get_origin

import msgspec
import numpy as np
import pytest

from skillc_dsl.position import Position
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.recording import events
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import (
    Event,
    Highlight,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    Note,
    WorldChanged,
)
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.reader import TraceError, TraceReader
from skillc_runtime.recording.reasons import FailedCallContext
from skillc_runtime.recording.writer import TraceWriter
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import (
    IndividualAdded,
    IndividualRemoved,
    LabelledClass,
    LabelledIdentity,
    LabelledIri,
    LabelledPose,
    LabelledProperty,
    LabelledQuantity,
    LabelledRelation,
    LabelledVector,
    NotFinite,
    ValueList,
)
from tree.library import FLAGS, ON, Library, act, call, sel, seq, world
from tree.stage import Script, Stage


def heard(body: object, cell: Stage) -> tuple[TreeRun, list[Event]]:
    """Run a body to its end and return what was told."""
    told: list[Event] = []
    run = TreeRun(body, Library().build(), cell, (told.append,))  # type: ignore[arg-type]
    while run.tick() is Status.RUNNING:
        cell.now += 0.1
    return run, told


def test_each_start_has_its_end_with_time_place_and_parent() -> None:
    cell = Stage(world(), {"a": [Script(ticks=3)], "b": [Script("fail")]})
    body = seq(act("a"), act("b"))
    _, told = heard(body, cell)
    starts = {event.node: event for event in told if isinstance(event, NodeStarted)}
    ends = {event.node: event for event in told if isinstance(event, NodeEnded)}
    assert starts.keys() == ends.keys() and len(starts) == 5
    root = next(event for event in starts.values() if event.parent == 0)
    assert root.source == body.source and root.kind == "seq"
    assert all(event.parent in starts for event in starts.values() if event is not root)
    first = next(event for event in starts.values() if event.source == body.children[0].source)
    assert (first.time, ends[first.node].time) == (0.0, pytest.approx(0.2))
    assert [event.status for event in ends.values()] == ["success", "success", "failure", "failure", "failure"]
    failure = ends[root.node].failure
    assert failure is not None and (failure.kind, failure.message, failure.skill) == ("body", "b failed", "Act")


def test_the_choice_is_told_with_those_rejected() -> None:
    cell = Stage(world(), {"a": [Script("refuse"), Script()]})
    _, told = heard(call("Either", name="a"), cell)
    choices = [event for event in told if isinstance(event, ImplementationChosen)]
    assert [choice.implementation for choice in choices] == ["way0", "way1"]
    assert choices[1].bindings == {"name": "a"}
    assert [(one.implementation, one.stage, one.reason) for one in choices[1].rejected] == [
        ("way0", "start", "a refuses")
    ]


def test_changes_of_the_world_are_told_while_the_run_lasts() -> None:
    cell = Stage(world())
    _, told = heard(call("Set", name="a", flag=FLAGS[0], value=False), cell)
    cell.world.commit([SetProperty(FLAGS[0], ON, True)])
    changes = [event for event in told if isinstance(event, WorldChanged)]
    assert [(event.origin, event.changes) for event in changes] == [
        ("Set", (LabelledProperty(LabelledIri(FLAGS[0], "stage:flag0"), LabelledIri(ON, "on"), False),))
    ]


def test_a_listener_that_fails_is_told_no_more() -> None:
    calls = []

    def failing(event: Event) -> None:
        calls.append(event)
        raise OSError("no space")

    told: list[Event] = []
    run = TreeRun(act("a"), Library().build(), Stage(world()), (failing, told.append))
    assert run.tick() is Status.SUCCESS
    assert len(calls) == 1 and len(told) > 1
    assert len(run.listener_problems) == 1 and "OSError: no space" in run.listener_problems[0]


def test_the_file_holds_what_was_told(tmp_path: Path) -> None:
    told: list[Event] = []
    with TraceWriter(tmp_path / "events.jsonl") as writer:
        publish = Publisher("run", (writer,))
        run = TreeRun(
            sel(call("Kept", name="a", flag=FLAGS[0]), act("b")),
            Library().build(),
            Stage(world()),
            (told.append, publish),
        )
        run.tick()
    assert list(TraceReader(tmp_path / "events.jsonl").events) == told and told
    assert writer.problem is None


def test_every_kind_of_event_survives_the_file(tmp_path: Path) -> None:
    kinds = [cls for cls in vars(events).values() if isinstance(cls, type) and issubclass(cls, events._Event)]
    samples = [sample(cls) for cls in kinds if cls is not events._Event]
    assert len(samples) >= 10
    assert list(TraceReader(written(tmp_path / "events.jsonl", samples)).events) == samples


def test_values_are_read_back_as_they_were_written(tmp_path: Path) -> None:
    arm, flag = LabelledIri("http://lab#Arm", "lab:Arm"), LabelledIri(FLAGS[0], "stage:flag0")
    pose = LabelledPose((0.1, 0.2, 0.3), (1.0, 0.0, 0.0, 0.0))
    values = (
        True,
        3,
        "text",
        arm,
        LabelledQuantity(5.0, "N"),
        LabelledVector((0.0, 0.0, 1.0)),
        NotFinite("inf N"),
        pose,
    )
    bindings = {str(number): value for number, value in enumerate((*values, ValueList((pose, ValueList(values)))))}
    facts = (LabelledRelation(arm, arm, None, False), LabelledProperty(arm, arm, None), LabelledClass(arm, flag))
    changes = (*facts[:2], IndividualAdded(arm, (flag,)), IndividualRemoved(arm))
    context = FailedCallContext(arguments=bindings, facts=(*facts, LabelledIdentity(arm, flag, False)))
    here = Position("a.skill", 1, 2)
    highlights = (Highlight("ends", arm, "pressed"),)
    samples = [
        ImplementationChosen(
            time=0.0, node=1, skill="A", implementation="b", bindings=bindings, highlights=highlights, source=here
        ),
        NodeEnded(time=1.0, node=1, name="A", status="failure", failed_call=context, source=here),
        WorldChanged(time=1.0, origin="A", changes=changes, known="sensed"),
    ]
    assert list(TraceReader(written(tmp_path / "events.jsonl", samples)).events) == samples


def test_a_failure_has_the_values_that_its_message_names() -> None:
    hole = LabelledIri("http://lab#Hole", "lab:Hole")
    values = {
        "depth": LabelledQuantity(0.01234, "m"),
        "hole": hole,
        "where": LabelledVector((0.1, 0.0, 0.2), "m"),
        "count": 3,
    }
    failure = SkillFailure("sank {depth:.1f mm} of {depth} into {hole} at {where:.2f}, {count} times", **values)
    assert str(failure) == "sank 12.3 mm of 0.01234 m into lab:Hole at (0.10, 0.00, 0.20) m, 3 times"
    assert failure.values == values
    foreign = SkillFailure("{share:.0%} of {most}", share=np.float64(0.5), most=LabelledQuantity(np.inf, "N"))
    assert str(foreign) == "50% of inf N"
    assert foreign.values == {"share": LabelledQuantity(0.5), "most": NotFinite("inf N")}
    assert str(SkillFailure("{braces} stay")) == "{braces} stay"


def written(path: Path, events: Sequence[Event]) -> Path:
    """Write a recording to a file and return it."""
    with TraceWriter(path) as writer:
        publish = Publisher("run", (writer,))
        for event in events:
            publish(event)
    assert writer.problem is None
    return path


def sample(cls: type) -> Any:
    """Make an event, or a part of one, with some value in each required field."""
    return cls(**{field.name: value(field.type) for field in msgspec.structs.fields(cls) if field.required})


def value(kind: Any) -> Any:
    """Make a value of a type."""
    plain = {float: 1.5, int: events.FORMAT, str: "text", tuple: (), dict: {}}
    match get_origin(kind):
        case typing.Literal:
            return get_args(kind)[0]
        case typing.Annotated:
            return value(get_args(kind)[0])
        case builtins.tuple if ... not in get_args(kind):
            return tuple(map(value, get_args(kind)))
        case typing.Union | types.UnionType:
            return value(get_args(kind)[0])
        case origin:
            known = origin or kind
            return plain[known] if known in plain else sample(known)


def test_a_last_line_cut_short_is_left_out(tmp_path: Path) -> None:
    path = written(tmp_path / "events.jsonl", [Note(time=1.0, message="one"), Note(time=2.0, message="two")])
    path.write_bytes(path.read_bytes()[:-5])
    reader = TraceReader(path)
    assert list(reader.events) == [Note(time=1.0, message="one")] and reader.is_truncated


def test_events_are_numbered_and_a_line_that_is_missing_or_of_another_run_is_an_error(tmp_path: Path) -> None:
    events = [Note(time=0.5 * number, message="all is well") for number in range(4)]
    path = written(tmp_path / "events.jsonl", events)
    envelopes = list(TraceReader(path))
    assert [(each.run, each.sequence, each.cell_time_s) for each in envelopes] == [
        ("run", number + 1, 0.5 * number) for number in range(4)
    ]
    assert all(one.wall_time_ns <= other.wall_time_ns for one, other in pairwise(envelopes))
    first, second, *others = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join((first, *others)))
    with pytest.raises(TraceError, match=r":2: event 2 of run is expected here, not event 3 of run$"):
        list(TraceReader(path))
    path.write_bytes(first + second.replace(b'"run":"run"', b'"run":"other"'))
    with pytest.raises(TraceError, match=r":2: event 2 of run is expected here, not event 2 of other$"):
        list(TraceReader(path))


def test_a_recorder_that_raises_is_removed_and_the_others_go_on() -> None:
    calls: list[Envelope] = []
    kept: list[Envelope] = []

    def broken(envelope: Envelope) -> None:
        calls.append(envelope)
        raise OSError("no space")

    publish = Publisher("run", (broken, kept.append))
    for number in range(3):
        publish(Note(time=float(number), message="hm"))
    assert len(calls) == 1 and [each.sequence for each in kept] == [1, 2, 3]
    assert len(publish.problems) == 1 and "OSError: no space" in publish.problems[0]


def test_a_full_disk_does_not_stop_the_run() -> None:
    writer = TraceWriter(Path("/dev/full"))
    run = TreeRun(seq(act("a"), act("b")), Library().build(), Stage(world()), (Publisher("run", (writer,)),))
    assert run.tick() is Status.SUCCESS
    writer.close()
    assert writer.problem is not None and "No space left" in writer.problem and run.listener_problems == ()


def test_the_outcome_is_the_tree_with_what_became_of_each_node() -> None:
    cell = Stage(world(), {"a": [Script("fail")]})
    run, _ = heard(sel(act("a"), act("b"), act("c")), cell)
    outcome = run.outcome
    assert [(child.name, child.status) for child in outcome.children] == [
        ("Act[way0]", "failure"),
        ("Act[way0]", "success"),
        ("Act", "idle"),
    ]
    (primitive,) = outcome.children[0].children
    assert (primitive.kind, primitive.name) == ("primitive", "Scripted")
    assert msgspec.json.decode(msgspec.json.encode(outcome), type=NodeOutcome) == outcome
