"""Makes the result of a task from its history, and from its execution where that is known."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Literal, cast

from msgspec import structs

from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.command_record import RecordedCommands
from skillc_runtime.evaluation.report.handlings import find_handlings, find_targets, measure_placements
from skillc_runtime.evaluation.report.result import (
    ChoiceResult,
    CommandsResult,
    FailedCall,
    StepResult,
    TaskResult,
    TouchResult,
    WorkResult,
)
from skillc_runtime.evaluation.report.run_start import summarise_start
from skillc_runtime.evaluation.report.wiping import Wiping, rate_wiping
from skillc_runtime.execution.execute import Execution
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.history.history import RecordedAttempt, RecordedCall, RunHistory
from skillc_runtime.recording.states import EndState


def summarise_run(
    execution: Execution[Any],
    history: RunHistory,
    wipings: Sequence[Wiping],
    backend: Backend,
    works: tuple[WorkResult, ...] = (),
    began_s: float = 0.0,
) -> TaskResult:
    """Return the result of a task for reports, tables and JSON; `wipings` and `works` were found in its history.

    The task began at `began_s` of its cell.
    """
    state, truth = backend.cell.world.snapshot(), backend.capabilities.truth
    judged = () if truth is None else tuple(rate_wiping(wiping, state, truth) for wiping in wipings)
    targets = find_targets(find_handlings(history, state))
    result = structs.replace(
        summarise_start(execution.task, backend, history.speed),
        status=_find_status(execution),
        verified=execution.verified,
        facts=execution.facts,
        false_claims=execution.false_claims,
        wiping=judged[0] if judged else None,
        wipings=judged,
        placements=measure_placements(backend.cell.world, truth, targets),
        works=works,
        touches=() if truth is None else tuple(TouchResult(**structs.asdict(each)) for each in truth.contacts()),
        failure=describe_failure(execution.failure) if execution.failure else None,
        cause=execution.failure,
    )
    if (record := backend.capabilities.commands) is not None:
        sent = tuple(_summarise_commands(each) for each in record.commands() if each.times_s.size)
        result = structs.replace(result, verified=None, commands=sent)
    result = _add_times(result, backend.clock.now - began_s, execution.wall_time_s)
    return _add_history(result, history) if execution.attempts else result


def summarise_recording(start: TaskResult, history: RunHistory, wall_time_s: float) -> TaskResult:
    """Return the result of a run from its recording, which has its end, and from what was known at its `start`.

    What is measured at the end, such as the quality of a wiping, is missing.
    """
    result = structs.replace(
        start,
        status=cast(EndState, history.status),
        verified=history.verified,
        false_claims=history.false_claims,
        facts=history.known,
        failure=describe_failure(history.failure) if history.failure is not None else None,
        cause=history.failure,
    )
    return _add_history(_add_times(result, history.last, wall_time_s), history)


def _summarise_commands(sent: RecordedCommands) -> CommandsResult:
    joint = int(sent.shares.argmax())
    return CommandsResult(
        arm=sent.arm,
        kind=sent.mode,
        count=int(sent.times_s.size),
        altered=sent.altered,
        joint=sent.joints[joint],
        greatest_share=float(sent.shares[joint]),
    )


def _add_times(result: TaskResult, took_s: float, wall_time_s: float) -> TaskResult:
    factor = took_s / wall_time_s if wall_time_s > 0.0 else 0.0
    return structs.replace(result, sim_time_s=took_s, wall_time_s=wall_time_s, real_time_factor=factor)


def _find_status(execution: Execution[Any]) -> EndState | Literal["refused"]:
    """Return how a task ended; it is refused if it could not be prepared, so that nothing ran."""
    failure = execution.failure
    unprepared = not execution.attempts and failure is not None and failure.kind == "plan"
    return "refused" if unprepared else execution.status


def _add_history(result: TaskResult, history: RunHistory) -> TaskResult:
    """Return a result with what was planned and done."""
    last = history.attempts[-1]
    failed = (each for each in history.chain if each.kind == "call")
    return structs.replace(
        result,
        plan=tuple(_make_step(each) for attempt in history.attempts for each in _list_steps(attempt, attempt is last)),
        planned_steps=last.planned,
        choices=_make_choices(history.calls),
        plan_optimal=last.optimal == "proven" if last.planner else None,
        plan_quality=last.quality,
        plan_in_space=last.space,
        planner=last.planner,
        replanned=tuple(each.replaces for each in history.attempts[1:]),
        sensed=tuple(each.replaces for each in history.attempts[1:] if each.sensed),
        failed_calls=tuple(FailedCall(name=each.name, source=each.source) for each in failed)
        if result.status == "failed"
        else (),
    )


def _list_steps(attempt: RecordedAttempt, is_last: bool) -> Iterator[RecordedCall]:
    """Yield the steps of an attempt; of one that was abandoned, those that were started."""
    yield from (step for step in attempt.steps if is_last or step.node)


def _make_step(call: RecordedCall) -> StepResult:
    defaults = {each.parameter for each in call.determined if each.how == "default"}
    return StepResult(
        skill=call.skill,
        implementation=call.implementation,
        arguments={name: value for name, value in call.bindings.items() if name not in defaults},
        source=str(call.implementation_source or call.source or ""),
        status=call.status,
        number=call.number,
        rounds=call.rounds,
        start_s=call.started,
        end_s=call.ended,
        failure=call.failure.message if call.failure is not None else None,
        fixed=call.fixed,
        alternatives=_count_alternatives(call),
        rejected=call.others,
    )


def _make_choices(calls: Iterator[RecordedCall]) -> tuple[ChoiceResult, ...]:
    """Return each choice between several implementations once."""
    found = {
        (call.skill, call.implementation): ChoiceResult(
            skill=call.skill, implementation=call.implementation, rejected=call.others
        )
        for call in calls
        if call.implementation and _count_alternatives(call)
    }
    return tuple(found[key] for key in sorted(found))


def _count_alternatives(call: RecordedCall) -> int:
    return len(call.others) + len(call.untried)
