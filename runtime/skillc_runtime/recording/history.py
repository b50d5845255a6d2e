"""From the events of a run to its story, in one pass and in memory that depends on the tree alone."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

from msgspec import structs

from skillc_runtime.recording import events
from skillc_runtime.recording.events import Event
from skillc_runtime.recording.record import AttemptRecord, NodeRecords
from skillc_runtime.recording.steps import collect_steps, failure_chain
from skillc_runtime.recording.story import Attempt, Fact, Story
from skillc_runtime.world.state.labelled import LabelledFact, LabelledProperty, LabelledRelation


def read_story(recording: Iterable[Event]) -> Story | None:
    """Return what happened in a run; None where no task ever started. Raises what the recording raises."""
    history = _History()
    for event in recording:
        history.hear(event)
    return history.story()


class _History:
    """Listens to a run; `story` may be asked at any time."""

    def __init__(self) -> None:
        self._started: events.TaskStarted | None = None
        self._ended: events.TaskEnded | None = None
        self._last = 0.0
        self._written: dict[LabelledFact, Fact] = {}
        self._because = ""
        self._bodies = [AttemptRecord()]
        self._records = NodeRecords(self._bodies[0])

    def hear(self, event: Event) -> None:
        """Take the next event."""
        self._last = event.time
        match event:
            case events.TaskStarted():
                self._started = event
            case events.PlanMade():
                self._begin(AttemptRecord(plan=event, replaces=self._because))
            case events.Replanned(reason=reason):
                self._because = reason
            case events.NodeStarted():
                self._records.start(event)
            case events.ImplementationChosen():
                self._records.choose(event)
            case events.NodeEnded():
                self._records.end(event, self._facts(event))
            case events.WorldChanged():
                self._note(event)
            case events.TaskEnded():
                self._ended = event
            case events.Note() | events.Paused() | events.Resumed():
                pass
            case _:
                assert_never(event)

    def story(self) -> Story | None:
        """Return what is known by now."""
        if self._started is None:
            return None
        attempts, count = [], 0
        for body in self._bodies:
            attempts.append(_attempt(body, count))
            count += len(attempts[-1].steps)
        return Story(
            task=self._started.task,
            status=self._ended.status if self._ended is not None else "",
            verified=self._ended.verified if self._ended is not None else None,
            known=self._ended.facts if self._ended is not None else (),
            library=self._started.library,
            hash=self._started.hash,
            format=self._started.format,
            last=self._last,
            failure=self._ended.failure if self._ended is not None else None,
            chain=failure_chain(self._bodies[-1].roots),
            attempts=tuple(attempts),
        )

    def _begin(self, body: AttemptRecord) -> None:
        """Begin an attempt; the first plan belongs to the body that nothing has run of yet."""
        if self._bodies[-1].plan is None and not self._bodies[-1].roots:
            self._bodies.pop()
        self._bodies.append(body)
        self._records = NodeRecords(body)

    def _note(self, event: events.WorldChanged) -> None:
        for change in event.changes:
            if isinstance(change, LabelledRelation | LabelledProperty):
                written = Fact(fact=change, since=event.time, by=event.origin, known=event.known or "")
                self._written[_about(change)] = written

    def _facts(self, event: events.NodeEnded) -> tuple[Fact, ...]:
        """Return the facts that a failure met, each with who wrote it if that was during the run."""
        found = event.attempted.facts if event.attempted is not None else ()
        pairs = ((fact, self._written.get(_about(fact))) for fact in found)
        return tuple(written if written and written.fact == fact else Fact(fact=fact) for fact, written in pairs)


def _about(fact: LabelledFact) -> LabelledFact:
    """Return what a fact is about, so that of a relation or a property only what was written last is kept."""
    return (
        structs.replace(fact, value=None) if isinstance(fact, LabelledProperty) else structs.replace(fact, holds=True)
    )


def _attempt(body: AttemptRecord, count: int) -> Attempt:
    plan = body.plan
    return Attempt(
        steps=collect_steps(body, count),
        planner=plan.planner if plan is not None else "",
        optimal=plan.optimal if plan is not None else "",
        quality=plan.quality if plan is not None else "",
        cost=plan.cost if plan is not None else None,
        replaces=body.replaces,
    )
