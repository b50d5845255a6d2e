"""Waits until a person has guided the tool to a pose by hand."""

from __future__ import annotations

from collections import deque
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.space.frames import relocation_changes
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import IS_TAUGHT

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

GUIDED_DISTANCE_M = 0.005
"""A tool that moved this far was guided, not pushed by accident, unless it took longer than LEADING_S."""

LEADING_S = 1.0
"""A tool that takes longer creeps by what its arm gets wrong of its own weight, and nobody leads it."""

STANDSTILL_M_S = 0.005
"""A tool that is slower than this stands still."""


class AwaitGuidance(Primitive):
    """Waits up to `patience` s until the tool was guided and then stood still for `still` s; writes its pose."""

    highlights = (("ends", "pose", "shown"),)
    moves = MappingProxyType({"pose": None})

    def __init__(self, cell: Cell, *, arm: str, pose: str, still: float, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._pose, self._still, self._patience = cell.arm(arm), pose, still, patience
        self._name, self._began, self._moved_at, self._was_led = arm, 0.0, 0.0, False
        self._from = np.zeros(3)
        self._path: deque[tuple[float, Array]] = deque()
        """Times of the last LEADING_S, and where the tool was (3,)."""

    def start(self) -> None:
        """Start waiting."""
        raise_fault(self.arm)
        self._began = self._moved_at = self.cell.now
        self._was_led = False
        self._path.clear()
        self._from = self.arm.measured.pose.position

    def tick(self) -> Status:
        """Return SUCCESS when the tool was guided to a pose and stands still."""
        raise_fault(self.arm)
        now, position = self.cell.now, self.arm.measured.pose.position
        away = float(np.linalg.norm(position - self._from))
        self._was_led = self._was_led or self._is_led(now, position)
        moves = float(np.linalg.norm(self.arm.measured.velocity[:3])) > STANDSTILL_M_S
        if away < GUIDED_DISTANCE_M or moves or not self._was_led:
            self._moved_at = now
        if now - self._moved_at >= self._still:
            placed = relocation_changes(self.cell.world.snapshot(), self._pose, self.arm.measured.pose)
            taught = [*placed, SetProperty(self._pose, IS_TAUGHT, True)]
            self.cell.world.commit(taught, "AwaitGuidance", "sensed")
            return Status.SUCCESS
        if now - self._began > self._patience:
            raise SkillFailure(
                "nobody guided the tool of {arm} to a pose within {patience}: it is {away:.0f mm} from its start",
                arm=label(self._name, self.cell.world.snapshot().vocabulary),
                patience=LabelledQuantity(self._patience, "s"),
                away=LabelledQuantity(away, "m"),
            )
        return Status.RUNNING

    def _is_led(self, now: float, position: Array) -> bool:
        """Whether the tool, which is at position (3,) now, has moved as far as one that is guided within LEADING_S."""
        self._path.append((now, position))
        while now - self._path[0][0] > LEADING_S:
            self._path.popleft()
        return float(np.linalg.norm(position - self._path[0][1])) >= GUIDED_DISTANCE_M
