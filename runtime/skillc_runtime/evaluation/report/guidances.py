"""Finds in a run when an arm yielded in all directions, as when a person guides it by hand, and measures it."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.devices.ground_truth import Guidance
from skillc_runtime.evaluation.report.pushes import find_pushes
from skillc_runtime.evaluation.report.result import GuidanceResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.run_trace import ArmPath
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import ARM_DEVICE

LEAST_S = 0.5
"""An arm that yields for a shorter time was not guided."""


class FreePeriod(msgspec.Struct, frozen=True):
    """A time in which an arm had no stiffness in any direction: its samples, and who guided it, None if nobody did."""

    arm: str
    samples: ArmPath
    guidance: Guidance | None

    @property
    def speed_mm_s(self) -> Array:
        """The speed (n,) of the tool in mm/s, from the measured joints."""
        return np.asarray(1e3 * np.linalg.norm(self.samples.velocity, axis=1))


def find_free_periods(record: RunRecord) -> tuple[FreePeriod, ...]:
    """Return all times in which arms yielded in all directions, by arm and in order of time."""
    return tuple(
        FreePeriod(arm, samples, _find_guidance(arm, samples, record))
        for arm in sorted(record.state.instances(ARM_DEVICE))
        for samples in _split(record.arm_path(arm))
        if not _is_pushing(arm, samples, record)
    )


def measure_guidance(period: FreePeriod, record: RunRecord) -> GuidanceResult:
    """Return the numbers of a time in which an arm yielded in all directions."""
    position, forces = period.samples.position, None if period.guidance is None else period.guidance.forces
    return GuidanceResult(
        arm=label(period.arm, record.state.vocabulary),
        start_s=float(period.samples.time[0]),
        end_s=float(period.samples.time[-1]),
        path_mm=float(1e3 * np.linalg.norm(np.diff(position, axis=0), axis=1).sum()),
        moved_mm=float(1e3 * np.linalg.norm(position[-1] - position[0])),
        greatest_speed_mm_s=float(period.speed_mm_s.max()),
        person_mean_n=None if forces is None else float(forces.mean()),
        person_greatest_n=None if forces is None else float(forces.max()),
    )


def _split(path: ArmPath) -> list[ArmPath]:
    """Return the parts of a path in which the commanded stiffness is 0 in all directions for long enough."""
    free = np.concatenate([[0], (~path.stiffness.any(axis=1)).astype(np.int8), [0]])
    edges = np.flatnonzero(np.diff(free))
    parts = [ArmPath(path.rows[first:last]) for first, last in edges.reshape(-1, 2)]
    return [each for each in parts if each.time[-1] - each.time[0] >= LEAST_S]


def _is_pushing(arm: str, samples: ArmPath, record: RunRecord) -> bool:
    """Whether an arm pushes while it yields, so that it goes where the push leads."""
    pushes = (each for each in find_pushes(record) if each.arm == arm)
    return any(each.start_s <= samples.time[-1] and samples.time[0] <= each.end_s for each in pushes)


def _find_guidance(arm: str, samples: ArmPath, record: RunRecord) -> Guidance | None:
    """Return how a person guided an arm in this time."""
    for each in () if record.truth is None else record.truth.guidances():
        inside = (each.times >= samples.time[0]) & (each.times <= samples.time[-1])
        if each.arm == arm and inside.any():
            return Guidance(each.place, each.forces[inside], each.times[inside], arm)
    return None
