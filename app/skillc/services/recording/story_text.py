"""Formats the explanation of a recorded run as text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain as together

from skillc_runtime.recording.failure import Failure, Rejection
from skillc_runtime.recording.failure_text import describe_failure, list_details
from skillc_runtime.recording.history.history import FailedNode, RecordedAttempt, RecordedCall, RecordedFact, RunHistory
from skillc_runtime.recording.history.origins import LocatedFact, ValueOrigin
from skillc_runtime.recording.history.question import CallSelection
from skillc_runtime.recording.known_facts import (
    describe_missing_sensing,
    format_evidence,
    format_false_claim,
    format_status,
    unverified_facts,
)
from skillc_runtime.recording.reasons import ParameterReason, UntriedImplementation
from skillc_runtime.world.state.labels.dirt_text import describe_dirt_map, written_dirt_map
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledIri, LabelledProperty
from skillc_runtime.world.state.labels.labelled_text import format_fact, format_value

HOW = {
    "passed": "passed by the caller",
    "planned": "bound by the planner",
    "default": "the default",
    "inferred": "found in the world",
    "given": "an argument of the task",
}
OF_BODY = ("let", "loop", "output", "given")
"""How names of a body or task get their values; other names are parameters of a call, whose number is shown."""


def format_overview(story: RunHistory, run: str) -> str:
    """Return the steps of a run, why there was more than one plan, and why the task failed; and what to ask next."""
    hint = f"Ask about a step, a skill or a parameter: `skillc why {run} {_example(story)}`"
    return "\n".join((*overview_lines(story), *(("", hint) if any(story.calls) else ())))


def overview_lines(story: RunHistory) -> list[str]:
    """Return the steps of a run, why there was more than one plan, and why the task failed."""
    lines = [f"{story.task}: {_ending(story)}"]
    for attempt in story.attempts:
        lines += _attempt(attempt)
    lines += _rests_on(story)
    lines += map(format_false_claim, story.false_claims)
    if story.failure is not None:
        lines += ["", f"why: {describe_failure(story.failure)}", *_indented(list_details(story.failure))]
        lines += _indented(_chain(story.chain, story.failure.message))
    return lines


def format_answer(answer: CallSelection) -> str:
    """Return the explanation of the calls that a question is about."""
    if answer.parameter:
        origins = {each.call: each for each in answer.origins}
        lines = (_parameter(call, answer.parameter, origins.get(call.number)) for call in answer.calls)
        return "\n".join(together.from_iterable(lines))
    return "\n\n".join("\n".join(explain_call(call)) for call in answer.calls)


def _ending(story: RunHistory) -> str:
    if story.status:
        return f"{format_status(story.status, story.verified, story.false_claims)} after {story.last:.1f} s"
    running = [call.skill for call in story.calls if call.status == "running"]
    where = f", in {' > '.join(running)}" if running else ""
    return f"the recording ends at {story.last:.1f} s, before the task does{where}"


def _rests_on(story: RunHistory) -> list[str]:
    """Return the facts that a success rests on and, for those that are not verified, what would confirm them."""
    if not story.known:
        return []
    lines = [f"{format_fact(each.fact)}  ({format_evidence(each)})" for each in story.known]
    return [
        "rests on:",
        *_indented(lines),
        *_indented(describe_missing_sensing(each) for each in unverified_facts(story.known)),
    ]


def _attempt(attempt: RecordedAttempt) -> Iterator[str]:
    if attempt.replaces:
        yield f"{'goes on' if attempt.sensed else 'planned again'}: {attempt.replaces}"
    if attempt.planner:
        quality = attempt.quality or {"proven": "proved optimal"}.get(attempt.optimal, "")
        proved = f", {quality}" if quality else ""
        count = f"{attempt.planned} step{'' if attempt.planned == 1 else 's'}"
        yield f"plan of {count} by {attempt.planner}{proved}, {attempt.cost:g} s expected"
        if attempt.space is not None:
            yield from _indented(attempt.space.text.splitlines())
    for step in attempt.steps:
        yield _line(step)
        yield from _indented(filter(None, [_arguments(step)]), 7)
    yield from _notes(attempt)


def _notes(attempt: RecordedAttempt) -> Iterator[str]:
    """Yield what was noted meanwhile, without what the plan says already."""
    known = "" if attempt.space is None else attempt.space.summary
    notes = [each for each in attempt.notes if not known or not each.message.endswith(known)]
    if notes:
        yield "noted:"
    yield from _indented(f"at {each.time:.1f} s: {each.message}" for each in notes)


def _arguments(call: RecordedCall) -> str:
    """Return the arguments that are not defaults, on one line."""
    defaults = {each.parameter for each in call.determined if each.how == "default"}
    return ", ".join(f"{name}: {format_value(value)}" for name, value in call.bindings.items() if name not in defaults)


def _line(call: RecordedCall, depth: int = 0) -> str:
    beside = f"  beside {', '.join(call.beside)}" if call.beside else ""
    rounds = f"  {', '.join(map(str, call.rounds))}" if call.rounds else ""
    name = f"{'  ' * depth}{call.number:>3}  {_name(call)}"
    return f"{name:32}  {call.status:11}  {_times(call):15}  {call.source or ''}{rounds}{beside}".rstrip()


def _name(call: RecordedCall) -> str:
    return f"{call.skill}[{call.implementation}]" if call.implementation else call.skill


def _times(call: RecordedCall) -> str:
    if call.started is None:
        return ""
    return f"{call.started:.1f} - {call.ended:.1f} s" if call.ended is not None else f"{call.started:.1f} s -"


def explain_call(call: RecordedCall) -> Iterator[str]:
    """Yield why a call chose what it did, how it ended, and why."""
    yield _line(call).strip()
    yield from _never(call)
    yield from _indented(_choice(call))
    if call.bindings:
        yield "  parameters:"
        yield from _indented(together.from_iterable(_bound(call, name) for name in call.bindings), 4)
    if call.found:
        yield "  found:"
        yield from _indented(map(_fact, call.found), 4)
    yield from _indented(_failed(call))
    if call.calls:
        yield "  calls inside:"
        yield from (_line(inner, 1) for inner in call.calls)


def _never(call: RecordedCall) -> Iterator[str]:
    if call.status == "skipped":
        yield "  skipped: its postconditions already held"
    if call.status == "not started":
        yield "  not started: the run ended or was planned again before"


def _choice(call: RecordedCall) -> Iterator[str]:
    if call.implementation:
        yield f"chosen: {call.implementation} ({call.implementation_source}), {_ground(call)}"
    if call.others:
        yield "rejected:"
        yield from _indented(together.from_iterable(map(_refusal, call.others)))
    if call.untried:
        yield "not tried, because they rank lower (less specific, less preferred, or declared later):"
        yield from (f"  {each.implementation} ({each.source}): {_would(each)}" for each in call.untried)


def _ground(call: RecordedCall) -> str:
    if call.fixed:
        return "which the call names"
    return "the first in rank that fits" if call.others or call.untried else "the only one"


def _would(untried: UntriedImplementation) -> str:
    return f"would not fit, {untried.reason}" if untried.reason else "would fit too"


def _refusal(rejected: Rejection) -> Iterator[str]:
    yield f"{rejected.implementation}: {rejected.reason} ({rejected.source})"
    if rejected.failure is not None:
        yield from _indented(_causes(rejected.failure.causes))


def _bound(call: RecordedCall, name: str) -> Iterator[str]:
    reason = next((each for each in call.determined if each.parameter == name), None)
    given = reason.how if reason is not None else "passed"
    how = "planned" if call.planned and given == "passed" else given
    written = call.expressions.get(name) if how != "planned" else None
    where = f": `{written.text}`, {written.source}" if written is not None else ""
    yield f"{name} = {format_value(call.bindings[name])}  ({HOW[how]}{where})"
    if reason is not None:
        yield from _indented(_because(reason))


def _because(reason: ParameterReason) -> Iterator[str]:
    for condition in reason.conditions:
        facts = "; ".join(map(format_fact, condition.facts))
        yield f"`{condition.text}` ({condition.source}): {facts or 'no fact decides it'}"
    yield from _passed_over(reason.others)


def _passed_over(others: Sequence[LabelledIri]) -> Iterator[str]:
    if others:
        yield f"`infer any` passed over {', '.join(other.label for other in others)}"


def _trace(origin: ValueOrigin, owner: str = "") -> Iterator[str]:
    """Yield where a value comes from, with each name that it was computed from below it; `owner` follows the name."""
    value = f" = {format_value(origin.value)}" if origin.value is not None else ""
    yield f"{origin.name}{owner}{value}  ({_describe_origin(origin)})"
    yield from _indented(f"`{each.text}` ({each.source})" for each in origin.conditions)
    yield from _indented(map(_located, origin.facts))
    yield from _indented(_passed_over(origin.others))
    for name in origin.names:
        yield from _indented(_trace(name, f" of {name.call}" if name.how not in OF_BODY else ""))


def _describe_origin(origin: ValueOrigin) -> str:
    match origin.how:
        case "let":
            how = "a `let`"
        case "loop":
            how = "an item of the loop over"
        case "output":
            return f"the output `{origin.text}` of call {origin.by}, {origin.source}" if origin.by else "an output"
        case _:
            how = HOW[origin.how]
    written = f"`{origin.text}`, " if origin.text else ""
    where = f"{written}{origin.source}" if origin.source is not None else ""
    return f"{how}{':' if written else ','} {where}" if where else how


def _located(located: LocatedFact) -> str:
    """Return a fact with when it was written in the run, or where the scene states it."""
    text = _fact(located.known)
    return text if located.place is None else f"{text}  ({located.place})"


def _failed(call: RecordedCall) -> Iterator[str]:
    if call.failure is None:
        return
    refused = [each for each in call.others if each.reason == call.failure.message]
    why = "no implementation is left" if refused else f"{call.failure.message} ({call.failure.source})"
    yield f"{'halted' if call.status == 'halted' else 'failed'}: {why}"
    yield from _indented(_causes(call.failure.causes))
    yield from _indented(_chain(call.chain[1:], call.failure.message))
    if call.facts:
        yield "facts at that moment:"
        yield from _indented(map(_fact, call.facts))


def _causes(causes: Sequence[Failure]) -> Iterator[str]:
    for cause in causes:
        yield f"because {cause.message} ({cause.source})"
        yield from _indented(_causes(cause.causes))


def _chain(links: Sequence[FailedNode], known: str = "") -> Iterator[str]:
    """Yield the failed nodes down to the innermost, whose message is omitted if `known` contains it."""
    for depth, link in enumerate(links):
        innermost = f": {link.message}" if link is links[-1] and link.message not in known else ""
        name = link.name if link.name.startswith(f"{link.kind} ") else f"{link.kind} {link.name}"
        yield f"{'  ' * depth}in {name} ({link.source}){innermost}"


def _fact(fact: RecordedFact) -> str:
    known = f"{fact.known}, " if fact.known else ""
    text = _map_of_dirt(fact.fact) or format_fact(fact.fact)
    return text if fact.since is None else f"{text}  ({known}since {fact.since:.1f} s, by {fact.by})"


def _map_of_dirt(fact: LabelledFact) -> str:
    """Return what a map of dirt shows, in words; nothing for other facts, and for a map that cannot be read."""
    dirt = written_dirt_map(fact)
    if dirt is None or not isinstance(fact, LabelledProperty):
        return ""
    return f"{fact.individual.label}.{fact.property.label}: {describe_dirt_map(dirt)}"


def _parameter(call: RecordedCall, name: str, origin: ValueOrigin | None) -> Iterator[str]:
    yield _line(call).strip()
    if origin is not None:
        yield from _indented(_trace(origin), 4)
    elif name in call.unset:
        yield f"    {name} has no value:"
        yield from _indented(together.from_iterable(map(_refusal, call.rejected)), 6)


def _indented(lines: Iterable[str], spaces: int = 2) -> Iterator[str]:
    return (f"{' ' * spaces}{line}" for line in lines)


def _example(story: RunHistory) -> str:
    """Return a question as an example: the last step that failed, else the first step."""
    failed = [call.number for call in story.calls if call.status == "failure" and "." not in call.number]
    return failed[-1] if failed else "1"
