"""What a question about a run asks for: a step by its number, a skill, an implementation, a parameter."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches

import msgspec

from skillc_runtime.recording.story import Call, Story

_NUMBER = re.compile(r"\d+(\.\d+)*")


class QuestionError(ValueError):
    """A question that is about nothing in the run; the message says what there is."""


class Answer(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """The calls that a question is about, in the order of the run, and the parameter that it is about, if it is."""

    question: str
    parameter: str = ""
    calls: tuple[Call, ...]


def find_answer(story: Story, question: str) -> Answer:
    """Return what a question is about: `2`, `2.1`, `Pick`, `Pick.gripper`, `2.gripper`, `gripper`, `by_grasp`.

    Of names the first that exists counts: a skill, an implementation, a parameter. Capitals do not matter.
    """
    text = question.strip().removeprefix("step ").strip()
    calls = tuple(story.calls)
    of_text = _about(calls, text)
    if of_text:
        return Answer(question=question, calls=of_text)
    owner, _, parameter = text.rpartition(".")
    found = _having(_about(calls, owner) if owner else calls, parameter)
    if found:
        return Answer(question=question, parameter=_spelled(found[0], parameter), calls=found)
    raise QuestionError(_nothing(calls, text))


def parameters_of(call: Call) -> tuple[str, ...]:
    """Return the parameters of which something is known."""
    return tuple(dict.fromkeys((*call.bindings, *call.unset)))


def _about(calls: Sequence[Call], text: str) -> tuple[Call, ...]:
    if _NUMBER.fullmatch(text):
        return _those(calls, lambda call: call.number == text)
    name = text.casefold()
    of_skill = _those(calls, lambda call: call.skill.casefold() == name)
    return of_skill or _those(calls, lambda call: name in _implementations(call))


def _those(calls: Sequence[Call], wanted: Callable[[Call], bool]) -> tuple[Call, ...]:
    return tuple(call for call in calls if wanted(call))


def _implementations(call: Call) -> frozenset[str]:
    names = (call.implementation, *(each.implementation for each in call.rejected))
    return frozenset(name.casefold() for name in names if name)


def _having(calls: Sequence[Call], parameter: str) -> tuple[Call, ...]:
    name = parameter.casefold()
    return _those(calls, lambda call: name in map(str.casefold, parameters_of(call)))


def _spelled(call: Call, parameter: str) -> str:
    return next(name for name in parameters_of(call) if name.casefold() == parameter.casefold())


def _nothing(calls: Sequence[Call], text: str) -> str:
    if _NUMBER.fullmatch(text):
        return _no_number(calls, text)
    owner, _, parameter = text.rpartition(".")
    owners = _about(calls, owner) if owner else ()
    if owners:
        known = dict.fromkeys(name for call in owners for name in parameters_of(call))
        return f"{owner} has no parameter `{parameter}`; it has {', '.join(known) or 'none'}"
    skills = dict.fromkeys(call.skill for call in calls)
    parameters = sorted({name for call in calls for name in parameters_of(call)})
    near = get_close_matches(parameter, [*skills, *parameters], n=1)
    hint = f"did you mean `{near[0]}`? " if near else ""
    return f"nothing in this run is called `{text}`; {hint}there are the skills {', '.join(skills) or '(none)'}"


def _no_number(calls: Sequence[Call], number: str) -> str:
    """Say which numbers there are: of steps, or of the calls inside the one that was meant."""
    above, _, _ = number.rpartition(".")
    around = next((call for call in calls if call.number == above), None)
    if above and around is None:
        return _no_number(calls, above)
    count = len(around.calls) if around is not None else sum("." not in call.number for call in calls)
    numbers = f"{above}.1 to {above}.{count}" if above else f"1 to {count}"
    if not count:
        return f"no skill was called in step {above}" if above else "no step ever began"
    return f"there is no step {number}; " + (f"those in {above} are {numbers}" if above else f"the steps are {numbers}")
