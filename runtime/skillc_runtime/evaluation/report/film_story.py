"""What the film of a run tells: a caption for each step, how the run ended, and the moments of its stills.

For wiping these are the grasp, the contact, a corner and the end of the lanes; for other work the highlights that its
primitives declare, for example a button that is pressed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf

import numpy as np

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.ground_truth import GroundTruth, Recording, join_recordings
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.film.captions import Caption, FilmEnding
from skillc_runtime.film.footage import Moment, Story
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.recording.known_facts import format_status
from skillc_runtime.world.state.labels.labelled import LabelledIri, display_name
from skillc_runtime.world.state.terms import ARM_DEVICE, END_EFFECTOR, HAS_ARM
from skillc_runtime.world.state.world_state import WorldState

GRASPED_S = 0.3
"""How long after a tool is first held the still of its grasp is taken."""


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


def find_moments(
    wipings: Sequence[Wiping], history: RunHistory, state: WorldState, truth: GroundTruth
) -> tuple[Moment, ...]:
    """Return the moments of all wipings whose arm is known, and the highlights of all calls, in the order of time."""
    wiped = (each for wiping in wipings if wiping.arm for each in _find_wiping_moments(wiping, truth))
    highlights = (each for call in history.calls for each in _find_highlights(call, state))
    return tuple(sorted((*wiped, *highlights), key=lambda each: each.time))


def _find_highlights(call: RecordedCall, state: WorldState) -> Iterator[Moment]:
    """Yield the moments of a call's highlights, if an arm executed it."""
    arms = state.instances(ARM_DEVICE)
    arm = next((each for each in call.individuals if each in arms), None)
    if arm is None:
        return
    for highlight in call.highlights:
        time = call.started if highlight.when == "begins" else call.ended
        occurred = highlight.when == "begins" or call.status == "success"
        if occurred and time is not None:
            yield Moment(f"{display_name(highlight.what.iri)} {highlight.word}", time, arm)


def _find_wiping_moments(wiping: Wiping, truth: GroundTruth) -> Iterator[Moment]:
    name, recording = display_name(wiping.surface), truth.recording(wiping.tool)
    yield Moment(f"{name} grasp", float(recording.time[0]) + GRASPED_S, wiping.arm)
    yield Moment(f"{name} contact", _find_contact_s(recording.between(wiping.began, wiping.end)), wiping.arm)
    yield Moment(f"{name} corner", _find_corner_s(_undisturbed(recording, wiping)), wiping.arm)
    yield Moment(f"{name} last lane", wiping.end, wiping.arm)


def _undisturbed(recording: Recording, wiping: Wiping) -> Recording:
    return join_recordings([recording.between(*each) for each in wiping.undisturbed])


def _find_contact_s(recording: Recording) -> float:
    """Return the time in s at which the tool was first pressed."""
    return float(recording.time[int(np.argmax(recording.force > 0))])


def _find_corner_s(window: Recording) -> float:
    """Return the time in s of a corner in the middle half of a wiping: where the path is slowest."""
    middle = slice(len(window.time) // 4, -len(window.time) // 4)
    speed = np.linalg.norm(window.path_velocity[middle], axis=1)
    return float(window.time[middle][int(speed.argmin())])
