"""What the film of a run says: a caption for each step, and how the run ended."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.film.captions import Caption, FilmEnding
from skillc_runtime.film.footage import Moment, Story
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.recording.known_facts import format_status
from skillc_runtime.world.state.labels.labelled import LabelledIri, display_name
from skillc_runtime.world.state.terms import ARM_DEVICE, END_EFFECTOR, HAS_ARM
from skillc_runtime.world.state.world_state import WorldState


def make_story(
    moments: Sequence[Moment], history: RunHistory, library: SkillLibrary, result: TaskResult, state: WorldState
) -> Story:
    """Return the story of a run with these stills."""
    return Story(moments, tuple(_make_captions(history, library, state)), _describe_end(result))


def _make_captions(history: RunHistory, library: SkillLibrary, state: WorldState) -> Iterator[Caption]:
    """Yield a caption for each step that ran, numbered within its attempt."""
    for attempt in history.attempts:
        calls = [(call.started, call) for call in attempt.steps if call.has_run and call.started is not None]
        for number, (started, call) in enumerate(calls, 1):
            words = (f"{number}/{len(calls)}", *_words(call, library, state))
            yield Caption("  ".join(words), started, inf if call.ended is None else call.ended)


def _words(call: RecordedCall, library: SkillLibrary, state: WorldState) -> Iterator[str]:
    """Yield the skill and what it was called with; robots, arms and hands can be seen."""
    yield call.skill
    given = [each.name for each in library.skills[call.skill].parameters if each.direction == "in"]
    values = (call.bindings[name] for name in given if name in call.bindings)
    things = [each.iri for each in values if isinstance(each, LabelledIri)]
    yield ", ".join(display_name(each) for each in things if not _is_device(each, state))


def _is_device(individual: str, state: WorldState) -> bool:
    devices = state.is_a(individual, ARM_DEVICE) or state.is_a(individual, END_EFFECTOR)
    return devices or bool(state.objects(individual, HAS_ARM))


def _describe_end(result: TaskResult) -> FilmEnding | None:
    status = format_status(result.status, result.verified, result.false_claims)
    match result.status:
        case "succeeded" if result.false_claims:
            return FilmEnding("failed", f"{status}: {result.false_claims[0]}")
        case "succeeded":
            return FilmEnding("unverified" if result.verified is False else "succeeded", status)
        case "failed":
            return FilmEnding("failed", f"{status}: {result.failure}" if result.failure else status)
        case _:
            return FilmEnding("stopped", f"{status}: {result.failure}" if result.failure else status)
