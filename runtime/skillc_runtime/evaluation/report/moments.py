"""Finds the moments of a run for still images.

For wiping these are the grasp, the contact, a corner and the end of the lanes; for other work the highlights that its
primitives declare, for example a button that is pressed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth, Recording, join_recordings
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.film.footage import Moment
from skillc_runtime.recording.history.history import RecordedCall, RunHistory
from skillc_runtime.world.state.labels.labelled import display_name
from skillc_runtime.world.state.terms import ARM_DEVICE
from skillc_runtime.world.state.world_state import WorldState

GRASPED_S = 0.3
"""How long after a tool is first held the still of its grasp is taken."""


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
