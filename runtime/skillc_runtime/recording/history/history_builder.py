"""Builds the history of a run from its events, in one pass; results, reports and explanations use it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Set
from typing import assert_never

import msgspec
from msgspec import structs

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.traversal import children
from skillc_runtime.recording import events
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.history.attempt_steps import collect_steps, failure_chain
from skillc_runtime.recording.history.history import (
    RecordedAttempt,
    RecordedCall,
    RecordedFact,
    RecordedNote,
    RunHistory,
)
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.history.node_records import AttemptRecord, NodeRecord, NodeRecords
from skillc_runtime.recording.reasons import WrittenExpression
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledProperty, LabelledRelation

OBSERVED = ("sensed", "idealised")
"""The evidence of what somebody has looked at."""


def read_history(recording: Iterable[Event]) -> RunHistory | None:
    """Return the history of a run, or None if no task was started. Raises what iterating over the recording raises."""
    return listen_to(recording).build()


def listen_to(recording: Iterable[Event]) -> HistoryBuilder:
    """Return a builder that has all events of a recording. Raises what iterating over the recording raises."""
    builder = HistoryBuilder()
    for event in recording:
        builder(event)
    return builder


class HistoryBuilder:
    """A listener that collects events; `build` and `draw` may be called at any time."""

    def __init__(self) -> None:
        self._started: events.TaskStarted | None = None
        self._ended: events.TaskEnded | None = None
        self._last = 0.0
        self._last_written: dict[LabelledFact, RecordedFact] = {}
        self._observed: list[RecordedFact] = []
        self._replanned = events.Replanned(time=0.0, reason="")
        self._pauses: list[tuple[float, float | None]] = []
        self._attempts = [AttemptRecord()]
        self._records = NodeRecords(self._attempts[0])

    def __call__(self, event: Event) -> None:
        """Add the next event."""
        self._last = event.time
        match event:
            case events.TaskStarted():
                self._started = event
            case events.PlanMade():
                why = self._replanned
                self._begin(AttemptRecord(plan=event, replaces=why.reason, sensed=why.sensed))
            case events.Replanned():
                self._replanned = event
            case events.NodeStarted():
                self._records.start(event)
            case events.ImplementationChosen():
                self._records.choose(event, self._written_before(event))
            case events.NodeEnded():
                self._records.end(
                    event, self._facts_of(event), [each for each in self._observed if each.since == event.time]
                )
            case events.WorldChanged():
                self._record_changes(event)
            case events.Paused() | events.Resumed():
                self._record_pause(event)
            case events.TaskEnded():
                self._ended = event
            case events.Note():
                self._attempts[-1].notes.append(event)
            case (
                events.StateChanged()
                | events.Requested()
                | events.Disturbed()
                | events.PlanArrived()
                | events.PromptsChanged()
            ):
                pass
            case _:
                assert_never(event)

    @property
    def history(self) -> RunHistory:
        """The history of a task that has started."""
        history = self.build()
        assert history is not None, "a task was started"
        return history

    def build(self) -> RunHistory | None:
        """Return the history up to now; None if no task was started."""
        if self._started is None:
            return None
        ended = self._ended
        return RunHistory(
            task=self._started.task,
            speed=self._started.settings.speed,
            status=ended.status if ended is not None else "",
            verified=ended.verified if ended is not None else None,
            known=ended.facts if ended is not None else (),
            false_claims=ended.false_claims if ended is not None else (),
            library=self._started.library,
            hash=self._started.hash,
            scene=self._started.scene,
            format=self._started.format,
            last=self._last,
            failure=ended.failure if ended is not None else None,
            chain=failure_chain(self._attempts[-1].roots),
            attempts=tuple(self._make_attempts()),
            pauses=tuple(self._pauses),
        )

    def draw(self) -> list[NodeOutcome]:
        """Return the tree of each attempt, in which each start of a call is a node."""
        history = self.build()
        if history is None:
            return []
        pairs = zip(self._attempts, history.attempts, strict=True)
        return [_draw_attempt(record, attempt, history) for record, attempt in pairs]

    def _make_attempts(self) -> list[RecordedAttempt]:
        attempts, count = list[RecordedAttempt](), 0
        for record in self._attempts:
            attempts.append(_make_attempt(record, count, self._body_to_do))
            count += len(attempts[-1].steps)
        return attempts

    @property
    def _body_to_do(self) -> tree.Node | None:
        """The body that was given, unless it has succeeded: then what was not called was not needed."""
        succeeded = self._ended is not None and self._ended.status == "succeeded"
        return None if self._started is None or succeeded else self._started.body

    def _begin(self, body: AttemptRecord) -> None:
        """Begin an attempt; the first plan replaces the empty first attempt."""
        if self._attempts[-1].plan is None and not self._attempts[-1].roots:
            body.notes = self._attempts.pop().notes
        self._attempts.append(body)
        self._records = NodeRecords(body)

    def _record_pause(self, event: events.Paused | events.Resumed) -> None:
        match event:
            case events.Paused():
                self._pauses.append((event.time, None))
            case events.Resumed():
                self._pauses[-1:] = [(start, event.time) for start, _ in self._pauses[-1:]]
            case _:
                assert_never(event)

    def _record_changes(self, event: events.WorldChanged) -> None:
        if self._observed and self._observed[-1].since != event.time:
            self._observed = []
        for change in event.changes:
            if isinstance(change, LabelledRelation | LabelledProperty):
                written = RecordedFact(fact=change, since=event.time, by=event.origin, known=event.known or "")
                self._last_written[_without_value(change)] = written
                if written.known in OBSERVED:
                    self._observed.append(written)

    def _facts_of(self, event: events.NodeEnded) -> tuple[RecordedFact, ...]:
        """Return the facts of a failed call, each with its origin if it was written during the run."""
        found = event.failed_call.facts if event.failed_call is not None else ()
        return tuple(self._find_written(fact) or RecordedFact(fact=fact) for fact in found)

    def _written_before(self, event: events.ImplementationChosen) -> tuple[RecordedFact, ...]:
        """Return the facts that the arguments of a call rest on and that were written during the run."""
        read = [fact for each in event.expressions.values() for fact in _facts_in(each)]
        read += [fact for each in event.determined for condition in each.conditions for fact in condition.facts]
        found = (self._find_written(fact) for fact in dict.fromkeys(read))
        return tuple(each for each in found if each is not None)

    def _find_written(self, fact: LabelledFact) -> RecordedFact | None:
        """Return when and by what a fact was written during the run; None if it was not."""
        written = self._last_written.get(_without_value(fact))
        return written if written is not None and written.fact == fact else None


def _find_wanted(node: msgspec.Struct, decided: Set[Position]) -> Iterator[tree.Call]:
    """Yield the calls of a body in the order of the text, without those below an `if` at a place in `decided`."""
    if isinstance(node, tree.Call):
        yield node
    elif not (isinstance(node, tree.If) and node.source in decided):
        for child in children(node):
            yield from _find_wanted(child, decided)


def _facts_in(expression: WrittenExpression) -> Iterator[LabelledFact]:
    yield from expression.facts
    for name in expression.names:
        if name.expression is not None:
            yield from _facts_in(name.expression)


def _without_value(fact: LabelledFact) -> LabelledFact:
    """Return a fact without its value, so that only the last value of a relation or property is kept."""
    return (
        structs.replace(fact, value=None) if isinstance(fact, LabelledProperty) else structs.replace(fact, holds=True)
    )


def _make_attempt(record: AttemptRecord, before: int, body: tree.Node | None) -> RecordedAttempt:
    """Return an attempt whose steps are numbered from `before` + 1.

    The calls of `body` that were not made are steps that were not started; None if none of them is missed.
    """
    calls = () if body is None or not record.roots else tuple(_find_wanted(body, record.decided))
    plan = record.plan
    return RecordedAttempt(
        steps=collect_steps(record, before, calls),
        planned=len(plan.steps) if plan is not None else 0,
        planner=plan.planner if plan is not None else "",
        optimal=plan.optimal if plan is not None else "",
        quality=plan.quality if plan is not None else "",
        space=plan.space if plan is not None else None,
        cost=plan.cost if plan is not None else None,
        replaces=record.replaces,
        sensed=record.sensed,
        notes=tuple(RecordedNote(time=each.time, message=each.message) for each in record.notes),
    )


def _draw_attempt(record: AttemptRecord, attempt: RecordedAttempt, history: RunHistory) -> NodeOutcome:
    """Return the tree of an attempt, with the steps that were not started at its end."""
    here = Position(path=history.library, line=1, column=1)
    roots = tuple(map(_draw, record.roots))
    missing = tuple(_draw_unstarted(each, here) for each in attempt.steps if not each.node)
    if len(roots) == 1 and not missing:
        return roots[0]
    if len(roots) == 1 and roots[0].kind != "call":
        return structs.replace(roots[0], children=(*roots[0].children, *missing))
    name, is_last = "plan" if attempt.planner else history.task, attempt is history.attempts[-1]
    status = "running" if is_last and not history.status else "idle" if not roots else "failure"
    return NodeOutcome(id=0, name=name, kind="seq", status=status, source=here, children=(*roots, *missing))


def _draw(record: NodeRecord) -> NodeOutcome:
    return NodeOutcome(
        id=record.start.node,
        name=_name(record),
        kind=record.start.kind,
        status=record.status,
        source=record.start.source,
        started=record.start.time,
        ended=record.ended,
        failure=record.failure,
        rejected=record.rejected,
        children=tuple(map(_draw, record.children)),
    )


def _name(record: NodeRecord) -> str:
    """Return the name of a node; that of a call has the last implementation, and in a loop the round."""
    chosen = record.choice
    name = record.start.name if chosen is None else f"{chosen.skill}[{chosen.implementation}]"
    return f"round {record.round}: {name}" if record.round else name


def _draw_unstarted(step: RecordedCall, here: Position) -> NodeOutcome:
    status = "skipped" if step.status == "skipped" else "idle"
    return NodeOutcome(id=0, name=step.skill, kind="call", status=status, source=step.source or here)
