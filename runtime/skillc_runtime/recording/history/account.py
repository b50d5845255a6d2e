"""Keeps account of a run while it goes on: its times, its failure, the outputs of its calls, what was measured."""

from __future__ import annotations

from datetime import UTC, datetime

import msgspec

from skillc_runtime.recording import events
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.labels.labelled import LabelledProperty, LabelledValue

MAX_LISTED = 100
"""How many outputs and how many measured properties are kept; the events have all."""


class CallOutput(msgspec.Struct, frozen=True):
    """What an outermost call of a run has returned for its parameter `name`; `node` is its number in the events."""

    skill: str
    node: int
    name: str
    value: LabelledValue


class MeasuredProperty(msgspec.Struct, frozen=True):
    """The value of a property that a skill or a device, `by`, has found last, at the time `time_s` of the cell."""

    fact: LabelledProperty
    known: Evidence
    by: str
    time_s: float


class RunAccount:
    """Follows the events of one run: a recorder.

    `started_at` is when its first attempt began, `ended_at` when it ended, in wall time; None before. `failure` is why
    it did not succeed, or why the step failed after which somebody has to decide how to go on. `outputs` are what its
    outermost calls have returned, `measures` the properties that were sensed, reported or measured without physics.
    """

    def __init__(self) -> None:
        self.started_at: datetime | None = None
        self.ended_at: datetime | None = None
        self.failure: Failure | None = None
        self.outputs: tuple[CallOutput, ...] = ()
        self.measures: tuple[MeasuredProperty, ...] = ()
        self._calls: dict[int, str] = {}  # the outermost calls that go on, with their skills
        self._inside: set[int] = set()  # the nodes inside of them

    def __call__(self, envelope: Envelope) -> None:
        """Take the next event."""
        match envelope.event:
            case events.StateChanged(state=state, failure=failure):
                self.failure = failure
                if state == "running" and self.started_at is None:
                    self.started_at = to_instant(envelope.wall_time_ns)
            case events.NodeStarted() as started:
                self._begin_node(started)
            case events.NodeEnded() as ended:
                self._end_node(ended)
            case events.WorldChanged(known=known) as changed if known not in (None, "assumed"):
                self._take_measures(changed, known)
            case events.TaskEnded(failure=failure):
                self.failure, self.ended_at = failure, to_instant(envelope.wall_time_ns)

    def _begin_node(self, started: events.NodeStarted) -> None:
        if started.parent in self._inside or started.parent in self._calls:
            self._inside.add(started.node)
        elif started.kind == "call":
            self._calls[started.node] = started.name

    def _end_node(self, ended: events.NodeEnded) -> None:
        self._inside.discard(ended.node)
        skill = self._calls.pop(ended.node, None)
        if skill is not None:
            returned = (CallOutput(skill, ended.node, name, value) for name, value in ended.outputs.items())
            self.outputs = (*self.outputs, *returned)[-MAX_LISTED:]

    def _take_measures(self, changed: events.WorldChanged, known: Evidence) -> None:
        found = {
            (each.individual.iri, each.property.iri): MeasuredProperty(each, known, changed.origin, changed.time)
            for each in changed.changes
            if isinstance(each, LabelledProperty) and each.value is not None
        }
        others = (each for each in self.measures if (each.fact.individual.iri, each.fact.property.iri) not in found)
        self.measures = (*others, *found.values())[-MAX_LISTED:]


def to_instant(wall_time_ns: int) -> datetime:
    """Return a wall time in ns since 1970 as a date and time in UTC."""
    return datetime.fromtimestamp(wall_time_ns // 1000 / 1e6, UTC)
