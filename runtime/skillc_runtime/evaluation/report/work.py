"""All kinds of work that a report knows, and what each measures; `work_figures.py` has their figures.

A kind is recognised by what was done in a run: activities of primitives, samples of devices, ground truth. A new kind
is a module that finds and measures it, an entry in `KINDS`, a function that draws it, and an entry in `FIGURES` there.
The two lists are apart because a run without a report draws nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np

from skillc_runtime.evaluation.report.guidances import find_free_periods, measure_guidance
from skillc_runtime.evaluation.report.handlings import Handling
from skillc_runtime.evaluation.report.pushes import PushRecord, find_pushes, measure_push
from skillc_runtime.evaluation.report.result import DriveResult, GraspResult, WorkResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.searches import find_searches, measure_search
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.labels.labelling import label

WorkKind: TypeAlias = Callable[[RunRecord], Iterator[WorkResult]]
"""A kind of work: yields the numbers of each piece of it in a run."""


LEAST_M = 0.02
"""A base that moved less did not drive."""

SETTLED_S = 0.2
"""How long after a grasp the grip is read."""


def measure_work(record: RunRecord) -> tuple[WorkResult, ...]:
    """Return the numbers of all work in a run."""
    return tuple(result for measure in KINDS for result in measure(record))


def find_other_pushes(record: RunRecord) -> Iterator[PushRecord]:
    """Yield the pushes besides those on surfaces that were wiped, whose numbers say more."""
    wiped = {each.surface for each in record.wipings}
    yield from (push for push in find_pushes(record) if not wiped.intersection(push.on))


def find_drives(record: RunRecord) -> dict[str, Array]:
    """Return the samples (n, 4) of each robot that drove, by IRI: time in s, position in m in the world."""
    return {robot: path for robot, path in record.trace.bases.paths.items() if _length_m(path) > LEAST_M}


def measure_drives(record: RunRecord) -> Iterator[DriveResult]:
    """Yield how far each base drove."""
    for robot, path in find_drives(record).items():
        yield DriveResult(robot=label(robot, record.state.vocabulary), path_m=_length_m(path))


def _length_m(path: Array) -> float:
    return float(np.linalg.norm(np.diff(path[:, 1:3], axis=0), axis=1).sum())


def measure_grasp(handling: Handling, record: RunRecord) -> GraspResult:
    """Return the numbers of a grasp."""
    vocabulary = record.state.vocabulary
    samples = record.trace.hands.path(handling.gripper)
    index = min(int(np.searchsorted(samples.time, handling.grasped_s + SETTLED_S)), len(samples.time) - 1)
    return GraspResult(
        thing=label(handling.thing, vocabulary),
        gripper=label(handling.gripper, vocabulary),
        grasped_s=handling.grasped_s,
        released_s=handling.released_s,
        force_n=_read(samples.finger_force, index),
        opening_mm=_read(1e3 * samples.measured_opening, index),
    )


def _read(values: Array, index: int) -> float | None:
    return float(values[index]) if len(values) and np.isfinite(values[index]) else None


KINDS: tuple[WorkKind, ...] = (
    lambda record: (measure_push(each, record) for each in find_other_pushes(record)),
    lambda record: (measure_search(each, record) for each in find_searches(record)),
    lambda record: (measure_guidance(each, record) for each in find_free_periods(record)),
    lambda record: (measure_grasp(each, record) for each in record.handlings),
    measure_drives,
)
"""What measures each kind of work, in the order of the report; `TaskResult.wipings` has the numbers of wiping."""
