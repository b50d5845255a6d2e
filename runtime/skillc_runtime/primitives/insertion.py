"""Noticing how deep a pushed tool has sunk into something."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, number
from skillc_runtime.world.state.terms import DEPTH, INSERTED_DEPTH, IS_SEATED

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell

STILL_M, STILL_S = 0.0003, 0.3
"""A tool that stays within this for that long rests; its speed is measured with too much noise to tell."""

SEATED_SHARE = 0.9
"""A peg that is in by this share of the hole's depth is at its bottom, as is one that seems as much too deep: where the
opening is, is not known better than that."""


class SinkBelow(Primitive):
    """Wait up to `patience` s until the tool is `depth` m below a target, against the unit direction `along` (3,)."""

    def __init__(self, cell: Cell, *, arm: str, target: Pose, along: Array, depth: float, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._target, self._along = cell.arm(arm), target.position, along
        self._depth, self._patience, self._began, self._deepest = depth, patience, 0.0, -np.inf

    def start(self) -> None:
        """Begin to wait."""
        raise_fault(self.arm)
        self._began = self.cell.now

    def tick(self) -> Status:
        """Return SUCCESS once the tool is deep enough."""
        raise_fault(self.arm)
        depth = float(self._along @ (self._target - self.arm.pose.position))
        self._deepest = max(self._deepest, depth)
        if depth >= self._depth:
            return Status.SUCCESS
        if self.cell.now - self._began > self._patience:
            raise SkillFailure(
                f"nothing gave way within {self._patience:g} s: the tool sank {self._deepest * 1e3:.1f} mm "
                f"below the target, not {self._depth * 1e3:g} mm"
            )
        return Status.RUNNING


class Seat(Primitive):
    """Wait up to `patience` s until a pushed peg rests in a socket; note its depth, and whether it is at the bottom."""

    def __init__(self, cell: Cell, *, arm: str, object: str, socket: str, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._peg, self._socket, self._patience = cell.arm(arm), object, socket, patience
        self._began = self._came_at = self._bottom = 0.0
        self._opening, self._place = Pose.of((0.0, 0.0, 0.0)), np.zeros(3)

    def start(self) -> None:
        """Look up where the opening is believed to be; SkillFailure when the hole's depth is not known."""
        raise_fault(self.arm)
        state = self.cell.world.snapshot()
        try:
            self._bottom = number(state, self._socket, DEPTH)
        except SheetError as error:
            raise SkillFailure(str(error)) from error
        self._opening = pose(state, self._socket)
        self._began = self._came_at = self.cell.now
        self._place = self.arm.pose.position

    def tick(self) -> Status:
        """Return SUCCESS once the peg rests at the bottom."""
        raise_fault(self.arm)
        place = self.arm.pose.position
        if float(np.linalg.norm(place - self._place)) > STILL_M:
            self._place, self._came_at = place, self.cell.now
        resting = self.cell.now - self._came_at >= STILL_S
        if not resting and self.cell.now - self._began <= self._patience:
            return Status.RUNNING
        depth = -float(self._opening.inverse().at(self.arm.pose.position)[2])
        seated = resting and abs(depth - self._bottom) <= (1 - SEATED_SHARE) * self._bottom
        noted = [SetProperty(self._peg, INSERTED_DEPTH, depth), SetProperty(self._peg, IS_SEATED, seated)]
        self.cell.world.commit(noted, "Seat", "sensed")
        if not seated:
            short = self.cell.world.snapshot().vocabulary.short
            rest = "rests" if resting else f"still moves after {self._patience:g} s,"
            raise SkillFailure(
                f"{short(self._peg)} {rest} {depth * 1e3:.1f} mm deep in {short(self._socket)}, "
                f"which is {self._bottom * 1e3:.1f} mm deep"
            )
        return Status.SUCCESS
