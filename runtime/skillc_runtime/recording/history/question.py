"""Selects the calls that a question about a run is about: by step number, skill, implementation or parameter."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches

import msgspec

from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.recording.history.origins import FindPlace, ValueOrigin, trace_values

_NUMBER = re.compile(r"\d+(\.\d+)*")


class QuestionError(ValueError):
    """A question about something that is not in the run; the message lists what is."""


class CallSelection(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The calls that a question is about, in the order of the run, and the parameter, if it is about one.

    `origins` are where the values of that parameter come from, for each call in which it has one.
    """

    question: str
    parameter: str = ""
    calls: tuple[RecordedCall, ...]
    origins: tuple[ValueOrigin, ...] = ()


def select_calls(story: RunHistory, question: str, find_place: FindPlace = lambda fact: None) -> CallSelection:
    """Return what a question is about: `2`, `2.1`, `Pick`, `Pick.gripper`, `2.gripper`, `gripper`, `by_grasp`.

    A name is looked up as a skill, then an implementation, then a parameter, ignoring case. QuestionError if none fits.
    """
    text = question.strip().removeprefix("step ").strip()
    calls = tuple(story.calls)
    by_name = _find_calls(calls, text)
    if by_name:
        return CallSelection(question=question, calls=by_name)
    owner, _, parameter = text.rpartition(".")
    found = _with_parameter(_find_calls(calls, owner) if owner else calls, parameter)
    if found:
        name = _exact_name(found[0], parameter)
        origins = trace_values(story, found, name, find_place)
        return CallSelection(question=question, parameter=name, calls=found, origins=origins)
    raise QuestionError(_describe_unknown(calls, text))


def parameters_of(call: RecordedCall) -> tuple[str, ...]:
    """Return the names of the parameters that are bound, or that could not be inferred."""
    return tuple(dict.fromkeys((*call.bindings, *call.unset)))


def _find_calls(calls: Sequence[RecordedCall], text: str) -> tuple[RecordedCall, ...]:
    if _NUMBER.fullmatch(text):
        return _filter(calls, lambda call: call.number == text)
    name = text.casefold()
    by_skill = _filter(calls, lambda call: call.skill.casefold() == name)
    return by_skill or _filter(calls, lambda call: name in _implementation_names(call))


def _filter(calls: Sequence[RecordedCall], is_wanted: Callable[[RecordedCall], bool]) -> tuple[RecordedCall, ...]:
    return tuple(call for call in calls if is_wanted(call))


def _implementation_names(call: RecordedCall) -> frozenset[str]:
    names = (call.implementation, *(each.implementation for each in call.rejected))
    return frozenset(name.casefold() for name in names if name)


def _with_parameter(calls: Sequence[RecordedCall], parameter: str) -> tuple[RecordedCall, ...]:
    name = parameter.casefold()
    return _filter(calls, lambda call: name in map(str.casefold, parameters_of(call)))


def _exact_name(call: RecordedCall, parameter: str) -> str:
    return next(name for name in parameters_of(call) if name.casefold() == parameter.casefold())


def _describe_unknown(calls: Sequence[RecordedCall], text: str) -> str:
    if _NUMBER.fullmatch(text):
        return _describe_missing_number(calls, text)
    owner, _, parameter = text.rpartition(".")
    owners = _find_calls(calls, owner) if owner else ()
    if owners:
        known = dict.fromkeys(name for call in owners for name in parameters_of(call))
        return f"{owner} has no parameter `{parameter}`; it has {', '.join(known) or 'none'}"
    skills = dict.fromkeys(call.skill for call in calls)
    parameters = sorted({name for call in calls for name in parameters_of(call)})
    near = get_close_matches(parameter, [*skills, *parameters], n=1)
    hint = f"did you mean `{near[0]}`? " if near else ""
    return f"nothing in this run is called `{text}`; {hint}there are the skills {', '.join(skills) or '(none)'}"


def _describe_missing_number(calls: Sequence[RecordedCall], number: str) -> str:
    """Return a message with the numbers that exist: of steps, or of the calls inside a step."""
    known = {call.number: call for call in reversed(calls)}
    prefix = max((each for each in known if number.startswith(f"{each}.")), key=len, default="")
    first = len(prefix) + 1 if prefix else 0
    number = number[:first] + number[first:].partition(".")[0]
    enclosing = known.get(prefix)
    count = len(enclosing.calls) if enclosing is not None else sum("." not in call.number for call in calls)
    numbers = f"{prefix}.1 to {prefix}.{count}" if prefix else f"1 to {count}"
    if not count:
        return f"no skill was called in step {prefix}" if prefix else "no step was started"
    return f"there is no step {number}; " + (
        f"those in {prefix} are {numbers}" if prefix else f"the steps are {numbers}"
    )
