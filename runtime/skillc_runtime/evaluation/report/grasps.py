"""Measures how things were grasped."""

from __future__ import annotations

import numpy as np

from skillc_runtime.evaluation.report.handlings import Handling
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.work_result import GraspResult
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.labels.labelling import label

SETTLED_S = 0.2
"""How long after a grasp the grip is read."""


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
