"""Makes the tree of an attempt for reports, in which each start of a call is a node."""

from __future__ import annotations

from msgspec import structs

from skillc_dsl.position import Position
from skillc_runtime.recording.history.history import RecordedAttempt, RecordedCall, RunHistory
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.recording.history.node_records import AttemptRecord, NodeRecord


def draw_attempt(record: AttemptRecord, attempt: RecordedAttempt, history: RunHistory) -> NodeOutcome:
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
