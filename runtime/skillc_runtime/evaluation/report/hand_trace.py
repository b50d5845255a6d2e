"""Samples, during a run, where hands are and how they grip, and where things lay at its start: ground truth."""

from __future__ import annotations

from contextlib import suppress

import msgspec
import numpy as np

from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.terms import ARM_DEVICE, CONTAIN, HAS_GRIPPER, MANIPULATABLE
from skillc_runtime.world.state.world_state import WorldState

PERIOD_S = 0.05
"""Time of the cell between two samples."""

COLUMNS = 7
"""time; position 3; opening; force; measured opening."""


class HandPath(msgspec.Struct, frozen=True):
    """Samples of a hand, one a row, (n, 7): time in s, true position in m in the world, true and measured grip.

    Where a value is not known it is NaN.
    """

    rows: Array

    @property
    def time(self) -> Array:
        """Time (n,) in s of the cell's clock."""
        return self.rows[:, 0]

    @property
    def position(self) -> Array:
        """True position (n, 3) of the tool centre point in m."""
        return self.rows[:, 1:4]

    @property
    def opening(self) -> Array:
        """True distance (n,) between the fingers in m."""
        return self.rows[:, 4]

    @property
    def finger_force(self) -> Array:
        """Force (n,) in N with which each finger presses."""
        return self.rows[:, 5]

    @property
    def measured_opening(self) -> Array:
        """Distance (n,) between the fingers in m that skills read last."""
        return self.rows[:, 6]

    def between(self, start: float, end: float) -> HandPath:
        """Return the samples with start <= time <= end, in s."""
        return HandPath(self.rows[(self.time >= start) & (self.time <= end)])


class HandTrace:
    """Samples every gripper of a cell; `start` is the world model and `lay` the true pose of each thing at the start.

    Where the truth is not known there are no samples.

    Only bodies that a skill can move are in `lay`, by IRI.
    """

    def __init__(self, backend: Backend) -> None:
        self._clock, self._truth = backend.clock, backend.capabilities.truth
        self.start: WorldState = backend.cell.world.snapshot()
        self.lay = {} if self._truth is None else _true_poses(self.start, self._truth)
        self._rows: dict[str, list[list[float]]] = {hand: [] for hand in _hands(self.start)}
        self._next = 0.0

    def sample(self) -> None:
        """Sample all hands if that is due."""
        if self._truth is None or self._clock.now < self._next:
            return
        self._next = self._clock.now + PERIOD_S
        for hand, rows in self._rows.items():
            rows.append(_row(self._clock.now, self._truth, hand))

    def path(self, hand: str) -> HandPath:
        """Return the samples of a gripper; KeyError if the cell has no such gripper."""
        return HandPath(np.array(self._rows[hand], dtype=float).reshape(-1, COLUMNS))


def _row(now: float, truth: GroundTruth, hand: str) -> list[float]:
    sample = truth.hand(hand)
    known = (np.nan if each is None else each for each in (sample.finger_force_n, sample.measured_m))
    return [now, *sample.position.tolist(), sample.opening_m, *known]


def _hands(state: WorldState) -> list[str]:
    return sorted({hand for arm in state.instances(ARM_DEVICE) for hand in state.objects(arm, HAS_GRIPPER)})


def _true_poses(state: WorldState, truth: GroundTruth) -> dict[str, Pose]:
    poses: dict[str, Pose] = {}
    for thing in sorted(state.instances(MANIPULATABLE)) if CONTAIN in state.vocabulary.relations else ():
        with suppress(KeyError):
            poses[thing] = truth.body_pose(thing)
    return poses
