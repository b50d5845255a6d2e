"""Moments of a run that are worth a still: of wiping, the grasp, the contact, a corner, the end of the lanes; of other
work what its primitives declare, as a button that is pressed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.film.film import Moment
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.node_outcome import NodeOutcome

GRASPED_S = 0.3
"""How long after the first moment at which a tool is held its grasp is looked at."""


def find_moments(
    wipings: Sequence[Wiping],
    trees: Iterable[NodeOutcome],
    choices: Mapping[int, ImplementationChosen],
    cell: SimulatedCell,
) -> tuple[Moment, ...]:
    """Return the moments of every wiping by an arm that is known, and of what else was to be seen in some trees."""
    wiped = (each for wiping in wipings if wiping.arm for each in _moments(wiping, cell))
    calls = ((node, choices[node.id]) for tree in trees for node in tree.nodes() if node.id in choices)
    return (*wiped, *(each for node, choice in calls for each in _seen(node, choice, cell)))


def _seen(node: NodeOutcome, choice: ImplementationChosen, cell: SimulatedCell) -> Iterator[Moment]:
    """Yield what was to be seen in a call, where an arm did it."""
    arms = {arm.individual for arm in cell.scene.arms}
    arm = next((each for each in choice.individuals if each in arms), None)
    if arm is None:
        return
    for highlight in choice.highlights:
        time = node.started if highlight.when == "begins" else node.ended
        came = highlight.when == "begins" or node.status == "success"
        if came and time is not None:
            yield Moment(f"{highlight.what.label} {highlight.word}", time, arm)


def _moments(wiping: Wiping, cell: SimulatedCell) -> Iterator[Moment]:
    name, recording = cell.world.snapshot().vocabulary.short(wiping.surface), cell.ground_truth.recording(wiping.tool)
    yield Moment(f"{name} grasp", float(recording.time[0]) + GRASPED_S, wiping.arm)
    yield Moment(f"{name} contact", _contact(recording.between(wiping.began, wiping.end)), wiping.arm)
    yield Moment(f"{name} corner", _corner(recording.between(wiping.start, wiping.end)), wiping.arm)
    yield Moment(f"{name} last lane", wiping.end, wiping.arm)


def _contact(recording: Recording) -> float:
    """Return when the tool was first pressed."""
    return float(recording.time[int(np.argmax(recording.force > 0))])


def _corner(window: Recording) -> float:
    """Return when the path turned in the middle half of a wiping, s: there it is slowest."""
    middle = slice(len(window.time) // 4, -len(window.time) // 4)
    speed = np.linalg.norm(window.path_velocity[middle], axis=1)
    return float(window.time[middle][int(speed.argmin())])
