"""Finds which mobile bases drove in a run, and how far."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.work_result import DriveResult
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.labels.labelling import label

LEAST_M = 0.02
"""A base that moved less did not drive."""


def find_drives(record: RunRecord) -> dict[str, Array]:
    """Return the samples (n, 4) of each robot that drove, by IRI: time in s, position in m in the world."""
    return {robot: path for robot, path in record.trace.bases.paths.items() if _length_m(path) > LEAST_M}


def measure_drives(record: RunRecord) -> Iterator[DriveResult]:
    """Yield how far each base drove."""
    for robot, path in find_drives(record).items():
        yield DriveResult(robot=label(robot, record.state.vocabulary), path_m=_length_m(path))


def _length_m(path: Array) -> float:
    return float(np.linalg.norm(np.diff(path[:, 1:3], axis=0), axis=1).sum())
