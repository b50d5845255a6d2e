"""Makes the steps of an attempt, with the calls inside them, from the records of its nodes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf

from msgspec import structs

from skillc_model.tree import Call
from skillc_runtime.recording.history.history import FailedNode, RecordedCall
from skillc_runtime.recording.history.node_records import AttemptRecord, NodeRecord
from skillc_runtime.recording.recorded_plan import PlanStep
from skillc_runtime.world.state.labels.labelled import LabelledValue


def collect_steps(body: AttemptRecord, before: int, wanted: Iterable[Call] = ()) -> tuple[RecordedCall, ...]:
    """Return the steps of an attempt in order of time, numbered from `before` + 1; those that never started come last.

    A step of a plan is matched with the first call of its skill with its arguments; without one it was skipped or not
    started. `wanted` are calls of a body; each at whose place no call was made is a step that was not started.
    """
    calls = [call for root in body.roots for call in ((root,) if root.is_call else root.calls)]
    places = {call.start.source for call in calls}
    missing = [PlanStep(skill=each.skill, arguments={}, source=each.source) for each in wanted]
    unstarted = [_unstarted_call(each, "not started") for each in missing if each.source not in places]
    found = _match_plan(body, calls)
    found += ((call.start.time, call) for call in calls)
    found += ((inf, each) for each in unstarted)
    found.sort(key=lambda each: each[0])
    numbered = tuple(_number_step(each, str(number)) for number, (_, each) in enumerate(found, start=before + 1))
    return _add_parallel_steps(tuple(structs.replace(each, planned=body.plan is not None) for each in numbered))


def _match_plan(body: AttemptRecord, calls: list[NodeRecord]) -> list[tuple[float, NodeRecord | RecordedCall]]:
    """Return the steps of a plan with their times, and take their calls out of the list."""
    skipped, found = list(body.skipped), list[tuple[float, NodeRecord | RecordedCall]]()
    for step in body.plan.steps if body.plan is not None else ():
        call = next((each for each in calls if _may_run(each, step)), None)
        if call is not None:
            calls.remove(call)
            found.append((call.start.time, call))
            continue
        skip = next((each for each in skipped if step.source is not None and each.source == step.source), None)
        if skip is None:
            found.append((inf, _unstarted_call(step, "not started")))
        else:
            skipped.remove(skip)
            found.append((skip.time, _unstarted_call(step, "skipped")))
    return found


def failure_chain(nodes: Sequence[NodeRecord]) -> tuple[FailedNode, ...]:
    """Return the chain of failures, outermost first: the calls and the innermost node; of several, the last to fail."""
    failed = [node for node in nodes if node.status == "failure"]
    if not failed:
        return ()
    last = max(failed, key=lambda node: node.ended or 0.0)
    below = failure_chain(last.latest)
    return (_make_failed_node(last), *below) if last.is_call or not below else below


def _make_failed_node(node: NodeRecord) -> FailedNode:
    failure = node.failure
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
    return call.failed_call.arguments if call.failed_call is not None else {}


def _unstarted_call(step: PlanStep, status: str) -> RecordedCall:
    return RecordedCall(number="", skill=step.skill, status=status, source=step.source, bindings=step.arguments)


def _number_step(found: NodeRecord | RecordedCall, number: str) -> RecordedCall:
    return structs.replace(found, number=number) if isinstance(found, RecordedCall) else _make_call(found, number)


def _make_call(call: NodeRecord, number: str) -> RecordedCall:
    choice, context, bindings = call.choice, call.failed_call, _bindings(call)
    inner = enumerate(call.calls, start=1)
    return RecordedCall(
        number=number,
        skill=_skill_of(call),
        status=call.status,
        source=call.start.source,
        node=call.start.node,
        implementation=choice.implementation if choice is not None else "",
        implementation_source=choice.source if choice is not None else None,
        rounds=call.loop_rounds,
        started=call.start.time,
        ended=call.ended,
        until=call.scope_end,
        bindings=bindings,
        determined=choice.determined if choice is not None else (),
        unset=tuple(name for name in context.unset if name not in bindings) if context is not None else (),
        fixed=choice.fixed if choice is not None else False,
        untried=choice.untried if choice is not None else (),
        rejected=call.rejected,
        failure=call.failure,
        chain=failure_chain([call]),
        facts=call.facts,
        expressions=choice.expressions if choice is not None else {},
        out=choice.out if choice is not None else "",
        outputs=call.end.outputs if call.end is not None else {},
        written=call.written,
        found=call.found,
        activity=choice.activity if choice is not None else "",
        highlights=choice.highlights if choice is not None else (),
        calls=tuple(_make_call(each, f"{number}.{place}") for place, each in inner),
    )


def _add_parallel_steps(found: tuple[RecordedCall, ...]) -> tuple[RecordedCall, ...]:
    """Return steps, which are in order of time, with the numbers of those that ran at the same time for a while."""
    beside: dict[str, list[str]] = {each.number: [] for each in found}
    going: list[tuple[float, RecordedCall]] = []
    for call in found:
        if call.started is None:
            continue
        begin, end = call.started, inf if call.ended is None else call.ended
        going = [(until, other) for until, other in going if until > begin]
        for _, other in going if end > begin else ():
            beside[call.number].append(other.number)
            beside[other.number].append(call.number)
        going.append((end, call))
    return tuple(structs.replace(call, beside=tuple(beside[call.number])) for call in found)
