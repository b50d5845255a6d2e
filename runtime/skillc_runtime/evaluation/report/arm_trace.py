"""Samples, during a run, what each arm measures of its tool and where it is sent: no ground truth."""

from __future__ import annotations

from contextlib import suppress

import msgspec
import numpy as np

from skillc_runtime.devices.arm_driver import ArmDriver
from skillc_runtime.devices.backend import Backend
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.terms import ARM_DEVICE

PERIOD_S = 0.01
"""Time of the cell between two samples, but for ticks that are longer."""

COLUMNS = 16
"""time; position 3; velocity 3; force 3; reference 3; commanded stiffness 3."""

FIRST_ROWS = 4096


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
        self._rows = {arm: np.empty((FIRST_ROWS, COLUMNS)) for arm in self._drivers}
        self._count = 0

    def sample(self) -> None:
        """Sample all arms if that is due."""
        now = self._clock.now
        if now < self._next:
            return
        self._next = now + 0.999 * PERIOD_S
        for arm, driver in self._drivers.items():
            if self._count == len(self._rows[arm]):
                self._rows[arm] = np.concatenate([self._rows[arm], np.empty_like(self._rows[arm])])
            _fill(self._rows[arm][self._count], now, driver)
        self._count += 1

    def path(self, arm: str) -> ArmPath:
        """Return the samples of an arm, read-only; KeyError if the cell has no such arm."""
        rows = self._rows[arm][: self._count]
        rows.flags.writeable = False
        return ArmPath(rows)


def _fill(row: Array, now: float, driver: ArmDriver) -> None:
    measured = driver.measured
    row[0], row[1:4], row[4:7] = now, measured.pose.position, measured.velocity[:3]
    row[7:10], row[10:13] = measured.wrench[:3], driver.motion.reference.pose.position
    row[13:16] = driver.compliance.commanded_stiffness[:3]
