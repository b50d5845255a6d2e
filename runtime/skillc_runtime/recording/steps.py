"""The steps of an attempt: those of its plan with the calls that ran them, and the calls inside."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from msgspec import structs

from skillc_runtime.recording.events import PlanStep
from skillc_runtime.recording.record import AttemptRecord, NodeRecord
from skillc_runtime.recording.story import Call, FailedNode
from skillc_runtime.world.state.labelled import LabelledValue


def collect_steps(body: AttemptRecord, before: int) -> tuple[Call, ...]:
    """Return the steps of an attempt, those of a plan in its order, numbered on from `before`.

    A step of a plan belongs to the first call of its skill with its arguments; one that has none was skipped or
    never started.
    """
    calls = [call for root in body.roots for call in ((root,) if root.is_call else root.calls)]
    skipped = [event.source for event in body.skipped]
    found: list[NodeRecord | Call] = []
    for step in body.plan.steps if body.plan is not None else ():
        call = next((each for each in calls if _runs(each, step)), None)
        if call is not None:
            calls.remove(call)
        passed_over = call is None and step.source is not None and step.source in skipped
        if passed_over and step.source is not None:
            skipped.remove(step.source)
        found.append(call or _planned(step, "skipped" if passed_over else "not started"))
    numbered = enumerate([*found, *calls], start=before + 1)
    as_calls = tuple(_step(each, str(number)) for number, each in numbered)
    return _side_by_side(tuple(structs.replace(each, planned=body.plan is not None) for each in as_calls))


def failure_chain(nodes: Sequence[NodeRecord]) -> tuple[FailedNode, ...]:
    """Return who failed together, outermost first: the calls and the innermost node, of several the last to fail."""
    failed = [node for node in nodes if node.status == "failure" and not node.survived]
    if not failed:
        return ()
    last = max(failed, key=lambda node: node.end.time if node.end is not None else 0.0)
    below = failure_chain(last.children)
    return (_link(last), *below) if last.is_call or not below else below


def _link(node: NodeRecord) -> FailedNode:
    failure = node.end.failure if node.end is not None else None
    name = node.end.name if node.end is not None else node.start.name
    source = failure.source if failure is not None and failure.source is not None and not node.is_call else None
    message = failure.message if failure is not None else ""
    return FailedNode(kind=node.start.kind, name=name, source=source or node.start.source, message=message)


def _runs(call: NodeRecord, step: PlanStep) -> bool:
    """Whether a call may be that of a planned step; its arguments are known once it chose or failed."""
    if _skill(call) != step.skill:
        return False
    bound = _bindings(call)
    return not bound or all(bound.get(name) == value for name, value in step.arguments.items())


def _skill(call: NodeRecord) -> str:
    return call.choice.skill if call.choice is not None else call.start.name.partition("[")[0]


def _bindings(call: NodeRecord) -> dict[str, LabelledValue]:
    if call.choice is not None:
        return call.choice.bindings
    attempted = call.end.attempted if call.end is not None else None
    return attempted.arguments if attempted is not None else {}


def _planned(step: PlanStep, status: str) -> Call:
    return Call(number="", skill=step.skill, status=status, source=step.source, bindings=step.arguments)


def _step(found: NodeRecord | Call, number: str) -> Call:
    return structs.replace(found, number=number) if isinstance(found, Call) else _call(found, number)


def _call(call: NodeRecord, number: str) -> Call:
    choice, end = call.choice, call.end
    attempted = end.attempted if end is not None else None
    rejected = attempted.rejected if attempted is not None else choice.rejected if choice is not None else ()
    bindings = _bindings(call)
    inner = enumerate(call.calls, start=1)
    return Call(
        number=number,
        skill=_skill(call),
        status=call.status,
        source=call.start.source,
        implementation=choice.implementation if choice is not None else "",
        implementation_source=choice.source if choice is not None else None,
        started=call.start.time,
        ended=end.time if end is not None else None,
        bindings=bindings,
        determined=choice.determined if choice is not None else (),
        unset=tuple(name for name in attempted.unset if name not in bindings) if attempted is not None else (),
        fixed=choice.fixed if choice is not None else False,
        untried=choice.untried if choice is not None else (),
        rejected=rejected,
        failure=end.failure if end is not None else None,
        chain=failure_chain([call]),
        facts=call.facts,
        starts=call.starts,
        earlier=tuple(call.earlier),
        calls=tuple(_call(each, f"{number}.{place}") for place, each in inner),
    )


def _side_by_side(found: tuple[Call, ...]) -> tuple[Call, ...]:
    return tuple(
        structs.replace(call, beside=tuple(other.number for other in found if other is not call and _meet(call, other)))
        for call in found
    )


def _meet(one: Call, other: Call) -> bool:
    """Whether two steps ran at the same time for a while."""
    if one.started is None or other.started is None:
        return False
    begin = max(one.started, other.started)
    return begin < min(inf if each.ended is None else each.ended for each in (one, other))
