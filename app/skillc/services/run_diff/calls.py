"""Compares the plans of two runs, and the calls that they have in common: choices, outcomes and times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import zip_longest

from skillc.contract.run_diff import Difference, Leaf
from skillc.services.run_diff.difference import compare_mappings, find_difference
from skillc_runtime.recording.history import Attempt, RecordedCall, RunHistory
from skillc_runtime.world.state.labelled import LabelledValue
from skillc_runtime.world.state.labelled_text import format_value

CallPair = tuple[RecordedCall, RecordedCall]


def compare_plans(one: RunHistory, other: RunHistory) -> Iterator[Difference]:
    """Yield how the plans differ, up to the first that has other steps: what follows depends on them."""
    for number, (first, second) in enumerate(zip_longest(one.attempts, other.attempts), 1):
        if first is None or second is None:
            yield from find_difference("plan", f"plan {number}", (_describe_plan(first), _describe_plan(second)))
            return
        yield from compare_mappings("plan", _about_plan(first, number), _about_plan(second, number))
        if step := _find_other_step(first, second):
            yield from step
            return


def pair_calls(one: RunHistory, other: RunHistory) -> list[CallPair]:
    """Return the calls that both runs have, outermost first; none after the first step that is another one."""
    found: list[CallPair] = []
    for first, second in zip(one.attempts, other.attempts, strict=False):
        for call, same in zip(first.steps, second.steps, strict=False):
            if _name_step(call) != _name_step(same):
                return found
            found += _pair_inner(call, same)
    return found


def compare_choices(pairs: list[CallPair]) -> Iterator[Difference]:
    """Yield the implementations and the values of parameters that differ."""
    for first, second in pairs:
        name = _name_call(first)
        yield from find_difference("choices", name, (first.implementation or None, second.implementation or None))
        yield from compare_mappings("choices", _about_parameters(first, name), _about_parameters(second, name))


def compare_outcomes(pairs: list[CallPair]) -> Iterator[Difference]:
    """Yield the calls that ended in another way, without those whose calls inside say the same."""
    ends = [(_describe_outcome(first), _describe_outcome(second)) for first, second in pairs]
    for place, ((call, _), end) in enumerate(zip(pairs, ends, strict=True)):
        inner = (said for (each, _), said in zip(pairs[place:], ends[place:], strict=True) if _is_inside(each, call))
        if end not in inner:
            yield from find_difference("outcomes", _name_call(call), end)


def compare_durations(pairs: list[CallPair]) -> Iterator[Difference]:
    """Yield the calls that took another time, in s of the cell."""
    for first, second in pairs:
        took, other = _duration(first), _duration(second)
        if took is not None and other is not None:
            yield from find_difference("times", _name_call(first), (took, other), abs(took - other))


def _about_plan(attempt: Attempt, number: int) -> dict[str, Leaf]:
    return {
        f"reason for plan {number}": attempt.replaces or None,
        f"planner of plan {number}": attempt.planner or None,
        f"quality of plan {number}": attempt.quality or None,
        f"expected duration of plan {number} in s": attempt.cost,
    }


def _describe_plan(attempt: Attempt | None) -> str | None:
    return None if attempt is None else ", ".join(map(_name_step, attempt.steps)) or "no steps"


def _find_other_step(first: Attempt, second: Attempt) -> tuple[Difference, ...]:
    for number, (one, other) in enumerate(zip_longest(first.steps, second.steps), 1):
        names = (None if one is None else _name_step(one), None if other is None else _name_step(other))
        if names[0] != names[1]:
            return find_difference("plan", f"step {number}", names)
    return ()


def _is_inside(call: RecordedCall, outer: RecordedCall) -> bool:
    return call.number.startswith(f"{outer.number}.")


def _name_step(call: RecordedCall) -> str:
    """Return a step with the arguments that the planner bound."""
    passed = _format_values(call.bindings) if call.planned else {}
    decided = {each.parameter for each in call.determined}
    return f"{call.skill}({', '.join(f'{name}: {text}' for name, text in passed.items() if name not in decided)})"


def _pair_inner(first: RecordedCall, second: RecordedCall) -> Iterator[CallPair]:
    """Yield a call and the calls inside that are the same, up to the first that is another one."""
    yield first, second
    if first.implementation == second.implementation:
        for call, same in zip(first.calls, second.calls, strict=False):
            if call.skill != same.skill:
                return
            yield from _pair_inner(call, same)


def _name_call(call: RecordedCall) -> str:
    return f"{call.number} {call.skill}"


def _about_parameters(call: RecordedCall, name: str) -> dict[str, Leaf]:
    return {f"{name}.{parameter}": text for parameter, text in _format_values(call.bindings).items()}


def _format_values(values: Mapping[str, LabelledValue]) -> dict[str, str]:
    return {name: format_value(value) for name, value in values.items()}


def _describe_outcome(call: RecordedCall) -> str:
    why = f": {call.failure.message}" if call.failure is not None else ""
    return f"{call.status}{why}"


def _duration(call: RecordedCall) -> float | None:
    return None if call.started is None or call.ended is None else round(call.ended - call.started, 6)
