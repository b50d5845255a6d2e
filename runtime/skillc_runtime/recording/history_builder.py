"""Builds the history of a run from its events, in one pass, with memory that depends only on the size of the tree."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf
from typing import assert_never

from msgspec import structs

from skillc_runtime.recording import events
from skillc_runtime.recording.events import Event, PlanStep
from skillc_runtime.recording.history import Attempt, FailedNode, RecordedCall, RecordedFact, RunHistory
from skillc_runtime.recording.node_records import AttemptRecord, NodeRecord, NodeRecords
from skillc_runtime.world.state.labelled import LabelledFact, LabelledProperty, LabelledRelation, LabelledValue


def read_history(recording: Iterable[Event]) -> RunHistory | None:
    """Return the history of a run, or None if no task was started. Raises what iterating over the recording raises."""
    builder = _HistoryBuilder()
    for event in recording:
        builder.add(event)
    return builder.build()


class _HistoryBuilder:
    """Collects events; `build` may be called at any time."""

    def __init__(self) -> None:
        self._started: events.TaskStarted | None = None
        self._ended: events.TaskEnded | None = None
        self._last = 0.0
        self._last_written: dict[LabelledFact, RecordedFact] = {}
        self._replan_reason = ""
        self._attempts = [AttemptRecord()]
        self._records = NodeRecords(self._attempts[0])

    def add(self, event: Event) -> None:
        """Add the next event."""
        self._last = event.time
        match event:
            case events.TaskStarted():
                self._started = event
            case events.PlanMade():
                self._begin(AttemptRecord(plan=event, replaces=self._replan_reason))
            case events.Replanned(reason=reason):
                self._replan_reason = reason
            case events.NodeStarted():
                self._records.start(event)
            case events.ImplementationChosen():
                self._records.choose(event)
            case events.NodeEnded():
                self._records.end(event, self._facts_of(event))
            case events.WorldChanged():
                self._record_changes(event)
            case events.TaskEnded():
                self._ended = event
            case events.StateChanged() | events.Requested() | events.Disturbed() | events.PlanArrived():
                pass
            case events.PromptsChanged() | events.Note() | events.Paused() | events.Resumed():
                pass
            case _:
                assert_never(event)

    def build(self) -> RunHistory | None:
        """Return the history up to now."""
        if self._started is None:
            return None
        attempts, count = [], 0
        for body in self._attempts:
            attempts.append(_make_attempt(body, count))
            count += len(attempts[-1].steps)
        return RunHistory(
            task=self._started.task,
            status=self._ended.status if self._ended is not None else "",
            verified=self._ended.verified if self._ended is not None else None,
            known=self._ended.facts if self._ended is not None else (),
            false_claims=self._ended.false_claims if self._ended is not None else (),
            library=self._started.library,
            hash=self._started.hash,
            format=self._started.format,
            last=self._last,
            failure=self._ended.failure if self._ended is not None else None,
            chain=failure_chain(self._attempts[-1].roots),
            attempts=tuple(attempts),
        )

    def _begin(self, body: AttemptRecord) -> None:
        """Begin an attempt; the first plan replaces the empty first attempt."""
        if self._attempts[-1].plan is None and not self._attempts[-1].roots:
            self._attempts.pop()
        self._attempts.append(body)
        self._records = NodeRecords(body)

    def _record_changes(self, event: events.WorldChanged) -> None:
        for change in event.changes:
            if isinstance(change, LabelledRelation | LabelledProperty):
                written = RecordedFact(fact=change, since=event.time, by=event.origin, known=event.known or "")
                self._last_written[_without_value(change)] = written

    def _facts_of(self, event: events.NodeEnded) -> tuple[RecordedFact, ...]:
        """Return the facts of a failed call, each with its origin if it was written during the run."""
        found = event.failed_call.facts if event.failed_call is not None else ()
        pairs = ((fact, self._last_written.get(_without_value(fact))) for fact in found)
        return tuple(
            written if written and written.fact == fact else RecordedFact(fact=fact) for fact, written in pairs
        )


def _without_value(fact: LabelledFact) -> LabelledFact:
    """Return a fact without its value, so that only the last value of a relation or property is kept."""
    return (
        structs.replace(fact, value=None) if isinstance(fact, LabelledProperty) else structs.replace(fact, holds=True)
    )


def _make_attempt(body: AttemptRecord, count: int) -> Attempt:
    plan = body.plan
    return Attempt(
        steps=collect_steps(body, count),
        planner=plan.planner if plan is not None else "",
        optimal=plan.optimal if plan is not None else "",
        quality=plan.quality if plan is not None else "",
        cost=plan.cost if plan is not None else None,
        replaces=body.replaces,
    )


def collect_steps(body: AttemptRecord, before: int) -> tuple[RecordedCall, ...]:
    """Return the steps of an attempt, those of a plan in its order, numbered from `before` + 1.

    A step of a plan is matched with the first call of its skill with its arguments; without one it was skipped or not
    started.
    """
    calls = [call for root in body.roots for call in ((root,) if root.is_call else root.calls)]
    skipped = [event.source for event in body.skipped]
    found: list[NodeRecord | RecordedCall] = []
    for step in body.plan.steps if body.plan is not None else ():
        call = next((each for each in calls if _may_run(each, step)), None)
        if call is not None:
            calls.remove(call)
        was_skipped = call is None and step.source is not None and step.source in skipped
        if was_skipped and step.source is not None:
            skipped.remove(step.source)
        found.append(call or _unstarted_call(step, "skipped" if was_skipped else "not started"))
    numbered = enumerate([*found, *calls], start=before + 1)
    as_calls = tuple(_number_step(each, str(number)) for number, each in numbered)
    return _add_parallel_steps(tuple(structs.replace(each, planned=body.plan is not None) for each in as_calls))


def failure_chain(nodes: Sequence[NodeRecord]) -> tuple[FailedNode, ...]:
    """Return the chain of failures, outermost first: the calls and the innermost node; of several, the last to fail."""
    failed = [node for node in nodes if node.status == "failure" and not node.was_handled]
    if not failed:
        return ()
    last = max(failed, key=lambda node: node.end.time if node.end is not None else 0.0)
    below = failure_chain(last.children)
    return (_make_failed_node(last), *below) if last.is_call or not below else below


def _make_failed_node(node: NodeRecord) -> FailedNode:
    failure = node.end.failure if node.end is not None else None
    name = node.end.name if node.end is not None else node.start.name
    source = failure.source if failure is not None and failure.source is not None and not node.is_call else None
    message = failure.message if failure is not None else ""
    return FailedNode(kind=node.start.kind, name=name, source=source or node.start.source, message=message)


def _may_run(call: NodeRecord, step: PlanStep) -> bool:
    """Whether a call may run a planned step; its arguments are known once it chose an implementation or failed."""
    if _skill_of(call) != step.skill:
        return False
    bound = _bindings(call)
    return not bound or all(bound.get(name) == value for name, value in step.arguments.items())


def _skill_of(call: NodeRecord) -> str:
    return call.choice.skill if call.choice is not None else call.start.name.partition("[")[0]


def _bindings(call: NodeRecord) -> dict[str, LabelledValue]:
    if call.choice is not None:
        return call.choice.bindings
    context = call.end.failed_call if call.end is not None else None
    return context.arguments if context is not None else {}


def _unstarted_call(step: PlanStep, status: str) -> RecordedCall:
    return RecordedCall(number="", skill=step.skill, status=status, source=step.source, bindings=step.arguments)


def _number_step(found: NodeRecord | RecordedCall, number: str) -> RecordedCall:
    return structs.replace(found, number=number) if isinstance(found, RecordedCall) else _make_call(found, number)


def _make_call(call: NodeRecord, number: str) -> RecordedCall:
    choice, end = call.choice, call.end
    context = end.failed_call if end is not None else None
    rejected = context.rejected if context is not None else choice.rejected if choice is not None else ()
    bindings = _bindings(call)
    inner = enumerate(call.calls, start=1)
    return RecordedCall(
        number=number,
        skill=_skill_of(call),
        status=call.status,
        source=call.start.source,
        node=call.start.node,
        implementation=choice.implementation if choice is not None else "",
        implementation_source=choice.source if choice is not None else None,
        started=call.start.time,
        ended=end.time if end is not None else None,
        bindings=bindings,
        determined=choice.determined if choice is not None else (),
        unset=tuple(name for name in context.unset if name not in bindings) if context is not None else (),
        fixed=choice.fixed if choice is not None else False,
        untried=choice.untried if choice is not None else (),
        rejected=rejected,
        failure=end.failure if end is not None else None,
        chain=failure_chain([call]),
        facts=call.facts,
        starts=call.starts,
        earlier=tuple(call.earlier),
        calls=tuple(_make_call(each, f"{number}.{place}") for place, each in inner),
    )


def _add_parallel_steps(found: tuple[RecordedCall, ...]) -> tuple[RecordedCall, ...]:
    return tuple(
        structs.replace(
            call, beside=tuple(other.number for other in found if other is not call and _overlap(call, other))
        )
        for call in found
    )


def _overlap(one: RecordedCall, other: RecordedCall) -> bool:
    """Whether two steps ran at the same time for a while."""
    if one.started is None or other.started is None:
        return False
    begin = max(one.started, other.started)
    return begin < min(inf if each.ended is None else each.ended for each in (one, other))
