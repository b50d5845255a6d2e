"""All samples that are taken during a run for its report: of arms, hands and bases."""

from __future__ import annotations

from contextlib import suppress

import msgspec
import numpy as np

from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.terms import ARM_DEVICE, CONTAIN, HAS_GRIPPER, MANIPULATABLE, MOBILE_ROBOT
from skillc_runtime.world.state.world_state import WorldState

ARM_PERIOD_S, HAND_PERIOD_S, BASE_PERIOD_S = 0.01, 0.05, 0.1
"""Time of the cell between two samples, but for ticks that are longer."""

ARM_COLUMNS = 16
"""time; position 3; velocity 3; force 3; reference 3; commanded stiffness 3."""

HAND_COLUMNS = 7
"""time; position 3; opening; force; measured opening."""

FIRST_ROWS = 4096


class RunTrace:
    """Samples a cell; `sample` is to be called in every tick. `began_s` is the time of the cell at the start, in s."""

    def __init__(self, backend: Backend) -> None:
        self.began_s = backend.clock.now
        self.arms, self.hands, self.bases = ArmTrace(backend), HandTrace(backend), BaseTrace(backend)

    def sample(self) -> None:
        """Sample what is due."""
        self.arms.sample()
        self.hands.sample()
        self.bases.sample()


class ArmPath(msgspec.Struct, frozen=True):
    """Samples of an arm (n, 16), one a row, in the world: time in s and the columns below in m, m/s, N and N/m."""

    rows: Array

    @property
    def time(self) -> Array:
        """Time (n,) in s of the cell's clock."""
        return self.rows[:, 0]

    @property
    def position(self) -> Array:
        """Position (n, 3) of the tool centre point in m, an estimate from the measured joints."""
        return self.rows[:, 1:4]

    @property
    def velocity(self) -> Array:
        """Velocity (n, 3) of the tool centre point in m/s, from the measured joints."""
        return self.rows[:, 4:7]

    @property
    def force(self) -> Array:
        """Force (n, 3) in N of the environment on the tool, measured or estimated."""
        return self.rows[:, 7:10]

    @property
    def reference(self) -> Array:
        """Commanded position (n, 3) in m."""
        return self.rows[:, 10:13]

    @property
    def stiffness(self) -> Array:
        """Commanded stiffness (n, 3) in N/m along the axes of the compliance frame."""
        return self.rows[:, 13:16]

    def between(self, start: float, end: float) -> ArmPath:
        """Return the samples with start <= time <= end, in s."""
        first, last = np.searchsorted(self.time, (start, np.nextafter(end, np.inf)))
        return ArmPath(self.rows[first:last])


class ArmTrace:
    """Samples every arm of a cell, in arrays that grow by doubling."""

    def __init__(self, backend: Backend) -> None:
        self._clock, self._next = backend.clock, 0.0
        self._drivers: dict[str, ArmDriver] = {}
        for arm in sorted(backend.cell.world.snapshot().instances(ARM_DEVICE)):
            with suppress(KeyError):
                self._drivers[arm] = backend.cell.arm(arm)
        self._rows = {arm: np.empty((FIRST_ROWS, ARM_COLUMNS)) for arm in self._drivers}
        self._count = 0

    def sample(self) -> None:
        """Sample all arms if that is due."""
        now = self._clock.now
        if now < self._next:
            return
        self._next = now + 0.999 * ARM_PERIOD_S
        for arm, driver in self._drivers.items():
            if self._count == len(self._rows[arm]):
                self._rows[arm] = np.concatenate([self._rows[arm], np.empty_like(self._rows[arm])])
            _fill_row(self._rows[arm][self._count], now, driver)
        self._count += 1

    def path(self, arm: str) -> ArmPath:
        """Return the samples of an arm, read-only; KeyError if the cell has no such arm."""
        rows = self._rows[arm][: self._count]
        rows.flags.writeable = False
        return ArmPath(rows)


def _fill_row(row: Array, now: float, driver: ArmDriver) -> None:
    measured = driver.measured
    row[0], row[1:4], row[4:7] = now, measured.pose.position, measured.velocity[:3]
    row[7:10], row[10:13] = measured.wrench[:3], driver.motion.reference.pose.position
    row[13:16] = driver.compliance.commanded_stiffness[:3]


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
        self._next = self._clock.now + HAND_PERIOD_S
        for hand, rows in self._rows.items():
            rows.append(_make_row(self._clock.now, self._truth, hand))

    def path(self, hand: str) -> HandPath:
        """Return the samples of a gripper; KeyError if the cell has no such gripper."""
        return HandPath(np.array(self._rows[hand], dtype=float).reshape(-1, HAND_COLUMNS))


def _make_row(now: float, truth: GroundTruth, hand: str) -> list[float]:
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


class BaseTrace:
    """Samples every mobile base of a cell."""

    def __init__(self, backend: Backend) -> None:
        self._clock, self._next = backend.clock, 0.0
        self._bases: dict[str, MobileBase] = {}
        for robot in sorted(backend.cell.world.snapshot().instances(MOBILE_ROBOT)):
            with suppress(KeyError):
                self._bases[robot] = backend.cell.base(robot)
        self._rows: dict[str, list[list[float]]] = {robot: [] for robot in self._bases}

    def sample(self) -> None:
        """Sample all bases if that is due."""
        now = self._clock.now
        if now < self._next:
            return
        self._next = now + BASE_PERIOD_S
        for robot, base in self._bases.items():
            self._rows[robot].append([now, *base.pose.position.tolist()])

    @property
    def paths(self) -> dict[str, Array]:
        """The samples (n, 4) of each robot, by IRI: time in s, position in m in the world."""
        return {robot: np.array(rows).reshape(-1, 4) for robot, rows in self._rows.items()}
