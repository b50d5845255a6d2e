"""Compares the plans of two runs, and the calls that they have in common: choices, outcomes and times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import zip_longest

from skillc.contract.runs.run_diff import Difference, Leaf
from skillc.services.run_diff.alignment import align
from skillc.services.run_diff.difference import compare_mappings, find_difference
from skillc_runtime.recording.history.history import RecordedAttempt, RecordedCall, RunHistory
from skillc_runtime.world.state.labels.labelled import LabelledValue
from skillc_runtime.world.state.labels.labelled_text import format_value

CallPair = tuple[RecordedCall, RecordedCall]


@dataclass(frozen=True, slots=True)
class PairedCalls:
    """The calls that both runs have, outermost first, and calls inside these that one of them lacks, with None."""

    pairs: list[CallPair] = field(default_factory=list)
    alone: list[tuple[RecordedCall | None, RecordedCall | None]] = field(default_factory=list)


def compare_plans(one: RunHistory, other: RunHistory) -> Iterator[Difference]:
    """Yield how the plans differ, up to the first that has other steps: what follows depends on them."""
    for number, (first, second) in enumerate(zip_longest(one.attempts, other.attempts), 1):
        if first is None or second is None:
            yield from find_difference("plan", f"plan {number}", (_describe_plan(first), _describe_plan(second)))
            return
        yield from compare_mappings("plan", _about_plan(first, number), _about_plan(second, number))
        if steps := list(_find_other_steps(first, second)):
            yield from steps
            return


def pair_calls(one: RunHistory, other: RunHistory) -> PairedCalls:
    """Return the calls that both runs have; none of plans after the first that has other steps."""
    found = PairedCalls()
    for first, second in zip(one.attempts, other.attempts, strict=False):
        for call, same in _align(first.steps, second.steps):
            if call is not None and same is not None:
                _add_pairs(call, same, found)
        if any(_find_other_steps(first, second)):
            break
    return found


def compare_choices(pairs: list[CallPair]) -> Iterator[Difference]:
    """Yield the implementations and the values of parameters that differ."""
    for first, second in pairs:
        name = _name_pair(first, second)
        yield from find_difference("choices", name, (first.implementation or None, second.implementation or None))
        yield from compare_mappings("choices", _about_parameters(first, name), _about_parameters(second, name))


def compare_outcomes(calls: PairedCalls) -> Iterator[Difference]:
    """Yield the calls that ended in another way, without those whose calls inside say the same, and the lone ones."""
    pairs = calls.pairs
    ends = [(_describe_outcome(first), _describe_outcome(second)) for first, second in pairs]
    for place, ((call, same), end) in enumerate(zip(pairs, ends, strict=True)):
        inner = (said for (each, _), said in zip(pairs[place:], ends[place:], strict=True) if _is_inside(each, call))
        if end not in inner:
            yield from find_difference("outcomes", _name_pair(call, same), end)
    for first, second in calls.alone:
        said, other = (None if each is None else _describe_outcome(each) for each in (first, second))
        yield from find_difference("outcomes", _name_pair(first, second), (said, other))


def compare_durations(pairs: list[CallPair]) -> Iterator[Difference]:
    """Yield the calls that took another time, in s of the cell."""
    for first, second in pairs:
        took, other = _duration(first), _duration(second)
        if took is not None and other is not None:
            yield from find_difference("times", _name_pair(first, second), (took, other), abs(took - other))


def _about_plan(attempt: RecordedAttempt, number: int) -> dict[str, Leaf]:
    return {
        f"reason for plan {number}": attempt.replaces or None,
        f"planner of plan {number}": attempt.planner or None,
        f"quality of plan {number}": attempt.quality or None,
        f"plan {number} in space": None if attempt.space is None else attempt.space.text,
        f"expected duration of plan {number} in s": attempt.cost,
    }


def _describe_plan(attempt: RecordedAttempt | None) -> str | None:
    return None if attempt is None else ", ".join(map(_name_step, attempt.steps)) or "no steps"


def _find_other_steps(first: RecordedAttempt, second: RecordedAttempt) -> Iterator[Difference]:
    """Yield the steps that one attempt lacks, and those that were planned with other arguments."""
    for one, other in _align(first.steps, second.steps):
        number = next(each.number for each in (one, other) if each is not None)
        if one is None or other is None or _is_planned_otherwise(one, other):
            name, same = (None if each is None else _name_step(each) for each in (one, other))
            yield from find_difference("plan", f"step {number}", (name, same))


def _is_planned_otherwise(first: RecordedCall, second: RecordedCall) -> bool:
    """Whether two steps were planned with other arguments; False if only one has started, which binds more of them."""
    comparable = first.planned and second.planned and (first.started is None) is (second.started is None)
    return comparable and _name_step(first) != _name_step(second)


def _align(
    first: Sequence[RecordedCall], second: Sequence[RecordedCall]
) -> Iterator[tuple[RecordedCall, RecordedCall] | tuple[RecordedCall, None] | tuple[None, RecordedCall]]:
    """Yield the calls of two bodies, paired by skill and arguments, and the rest by skill alone."""
    return align(first, second, _name_step, lambda call: call.skill)


def _is_inside(call: RecordedCall, outer: RecordedCall) -> bool:
    return call.number.startswith(f"{outer.number}.")


def _name_step(call: RecordedCall) -> str:
    """Return a step with the arguments that were passed or that the planner bound."""
    decided = {each.parameter for each in call.determined}
    passed = _format_values(call.bindings).items()
    return f"{call.skill}({', '.join(f'{name}: {text}' for name, text in passed if name not in decided)})"


def _add_pairs(first: RecordedCall, second: RecordedCall, found: PairedCalls) -> None:
    """Add a call and the calls inside it, if these are those of the same implementation."""
    found.pairs.append((first, second))
    if first.implementation != second.implementation:
        return
    for call, same in _align(first.calls, second.calls):
        if call is not None and same is not None:
            _add_pairs(call, same, found)
        else:
            found.alone.append((call, same))


def _name_pair(first: RecordedCall | None, second: RecordedCall | None) -> str:
    """Return the number and skill of a call, with both numbers if they differ."""
    calls = [each for each in (first, second) if each is not None]
    return f"{'/'.join(dict.fromkeys(each.number for each in calls))} {calls[0].skill}"


def _about_parameters(call: RecordedCall, name: str) -> dict[str, Leaf]:
    return {f"{name}.{parameter}": text for parameter, text in _format_values(call.bindings).items()}


def _format_values(values: Mapping[str, LabelledValue]) -> dict[str, str]:
    return {name: format_value(value) for name, value in values.items()}


def _describe_outcome(call: RecordedCall) -> str:
    why = f": {call.failure.message}" if call.failure is not None else ""
    return f"{call.status}{why}"


def _duration(call: RecordedCall) -> float | None:
    return None if call.started is None or call.ended is None else round(call.ended - call.started, 6)
