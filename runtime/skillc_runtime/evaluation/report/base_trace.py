"""Samples, during a run, where mobile bases are, as they report it."""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.base import MobileBase
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.terms import MOBILE_ROBOT

PERIOD_S = 0.1
"""Time of the cell between two samples."""


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
        self._next = now + PERIOD_S
        for robot, base in self._bases.items():
            self._rows[robot].append([now, *base.pose.position.tolist()])

    @property
    def paths(self) -> dict[str, Array]:
        """The samples (n, 4) of each robot, by IRI: time in s, position in m in the world."""
        return {robot: np.array(rows).reshape(-1, 4) for robot, rows in self._rows.items()}
