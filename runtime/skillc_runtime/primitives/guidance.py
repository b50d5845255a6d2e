"""Waiting until somebody has led the tool to a place by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.space.frames import placed
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import IS_TAUGHT

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell

LED_M = 0.005
"""A tool that has come this far was led, not pushed by accident."""

STILL_M_S = 0.005
"""A tool slower than this stands still."""


class AwaitGuidance(Primitive):
    """Wait up to `patience` s until the tool was led somewhere and stood still for `still` s; note where that is."""

    def __init__(self, cell: Cell, *, arm: str, pose: str, still: float, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._pose, self._still, self._patience = cell.arm(arm), pose, still, patience
        self._name, self._began, self._moved_at = arm, 0.0, 0.0
        self._from = np.zeros(3)

    def start(self) -> None:
        """Begin to wait."""
        raise_fault(self.arm)
        self._began = self._moved_at = self.cell.now
        self._from = self.arm.pose.position

    def tick(self) -> Status:
        """Return SUCCESS once the tool was led somewhere and stands there."""
        raise_fault(self.arm)
        now, away = self.cell.now, float(np.linalg.norm(self.arm.pose.position - self._from))
        if away < LED_M or float(np.linalg.norm(self.arm.velocity[:3])) > STILL_M_S:
            self._moved_at = now
        if now - self._moved_at >= self._still:
            taught = [*placed(self._pose, self.arm.pose), SetProperty(self._pose, IS_TAUGHT, True)]
            self.cell.world.commit(taught, "AwaitGuidance", "sensed")
            return Status.SUCCESS
        if now - self._began > self._patience:
            name = self.cell.world.snapshot().vocabulary.short(self._name)
            raise SkillFailure(
                f"nobody led the tool of {name} to a place within {self._patience:g} s: it is {away * 1e3:.0f} mm away"
            )
        return Status.RUNNING
