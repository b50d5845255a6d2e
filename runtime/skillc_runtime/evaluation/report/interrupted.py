"""Makes the result of a task from its recording, for a run whose process could not make it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from msgspec import structs

from skillc_rdf.vocabulary.types import Position
from skillc_runtime.evaluation.report.result import ChoiceResult, StepResult, TaskResult
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.history import Attempt, RecordedCall, RunHistory
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.recording.states import EndState
from skillc_runtime.world.state.labelled import LabelledIri

_NOT_STARTED = ("skipped", "not started")


def summarise_recording(start: TaskResult, history: RunHistory, wall_time_s: float) -> TaskResult:
    """Return the result of a run from its recording, which has its end, and from what was known at its `start`.

    What is measured at the end, such as the quality of a wiping, is missing.
    """
    last = history.attempts[-1]
    return structs.replace(
        start,
        status=cast(EndState, history.status),
        verified=history.verified,
        false_claims=history.false_claims,
        facts=history.known,
        plan=tuple(_make_step(call) for call in last.steps),
        choices=_make_choices(history.calls),
        plan_optimal=last.optimal == "proven" if last.planner else None,
        plan_quality=last.quality,
        planner=last.planner,
        sim_time_s=history.last,
        wall_time_s=wall_time_s,
        real_time_factor=history.last / wall_time_s if wall_time_s > 0.0 else 0.0,
        replanned=tuple(each.replaces for each in history.attempts[1:]),
        failure=describe_failure(history.failure) if history.failure is not None else None,
        cause=history.failure,
    )


def draw_attempts(history: RunHistory) -> list[NodeOutcome]:
    """Return the calls of each attempt as a tree for the report; a recording has no other nodes that ended well."""
    return [_draw_attempt(attempt, history) for attempt in history.attempts]


def _draw_attempt(attempt: Attempt, history: RunHistory) -> NodeOutcome:
    here = Position(path=history.library, line=1, column=1)
    name = "plan" if attempt.planner else history.task
    status = "running" if attempt is history.attempts[-1] else "failure"
    steps = tuple(_draw_call(step, here) for step in attempt.steps)
    return NodeOutcome(id=0, name=name, kind="seq", status=status, source=here, children=steps)


def _draw_call(call: RecordedCall, here: Position) -> NodeOutcome:
    return NodeOutcome(
        id=0,
        name=f"{call.skill}[{call.implementation}]" if call.implementation else call.skill,
        kind="call",
        status="idle" if call.status in _NOT_STARTED else call.status,
        source=call.source or here,
        started=call.started,
        ended=call.ended,
        failure=call.failure,
        rejected=call.rejected,
        children=tuple(_draw_call(inner, here) for inner in call.calls),
    )


def _make_step(call: RecordedCall) -> StepResult:
    return StepResult(
        skill=call.skill,
        implementation=call.implementation,
        arguments={name: value for name, value in call.bindings.items() if isinstance(value, LabelledIri)},
        source=str(call.implementation_source or call.source or ""),
        status="idle" if call.status == "not started" else call.status,
        alternatives=_count_alternatives(call),
        rejected=call.rejected,
    )


def _make_choices(calls: Iterator[RecordedCall]) -> tuple[ChoiceResult, ...]:
    """Return each choice between several implementations once."""
    found = {
        (call.skill, call.implementation): ChoiceResult(
            skill=call.skill, implementation=call.implementation, rejected=call.rejected
        )
        for call in calls
        if call.implementation and _count_alternatives(call)
    }
    return tuple(found[key] for key in sorted(found))


def _count_alternatives(call: RecordedCall) -> int:
    return len(call.rejected) + len(call.untried)
