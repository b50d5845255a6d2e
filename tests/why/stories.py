"""Stories of runs on the stage and in the depot, and their folders."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from skillc_model import tree
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import FORMAT, Event, TaskEnded, TaskStarted
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.recording.history.history_builder import read_history
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.states import EndState
from skillc_runtime.recording.writer import TraceWriter
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState
from tree.stage import PERIOD_S, Stage

END_STATES: Mapping[Status, EndState] = {
    Status.SUCCESS: "succeeded",
    Status.FAILURE: "failed",
    Status.HALTED: "stopped",
}
BEGIN = TaskStarted(time=0.0, format=FORMAT, task="play", library="stage")


def events_of(body: tree.Node, library: SkillLibrary, cell: Stage, ticks: int = 40) -> list[Event]:
    """Run a body and return what a recording of it says."""
    told: list[Event] = [BEGIN]
    run = TreeRun(body, library, cell, (told.append,))
    for _ in range(ticks):
        if run.tick() is not Status.RUNNING:
            break
        cell.now += PERIOD_S
    run.halt("enough")
    told.append(TaskEnded(time=cell.now, task="play", status=END_STATES[run.status], failure=run.failure))
    return told


def in_world(body: tree.Node, library: SkillLibrary, state: WorldState) -> RunHistory:
    """Return the story of a body in a world."""
    return known(read_history(events_of(body, library, Stage(WorldModel(state)))))


def known(story: RunHistory | None) -> RunHistory:
    """Return the story of a run that has started."""
    assert story is not None
    return story


def written(folder: Path, events: Sequence[Event]) -> Path:
    """Write a recording."""
    folder.mkdir(exist_ok=True)
    with TraceWriter(folder / "events.jsonl") as writer:
        publish = Publisher("run", (writer,))
        for event in events:
            publish(event)
    assert writer.problem is None
    return folder


def steps_of(story: RunHistory) -> list[RecordedCall]:
    """Return the steps of all attempts."""
    return list(story.steps)
