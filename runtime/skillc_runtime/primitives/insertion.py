"""Measures how deep a pushed tool or peg is inserted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.primitives.time_limits import describe_slowness
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import DEPTH, INSERTED_DEPTH, IS_SEATED

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

REST_RANGE_M, REST_TIME_S = 0.0003, 0.3
"""A tool that stays within REST_RANGE_M for REST_TIME_S is at rest; its measured speed is too noisy."""

SEATED_SHARE = 0.9
"""A peg is at the bottom of a hole if its depth differs from the hole's by at most the rest of this share: the position
of the opening is not known better than that."""


UNSURE_M = 0.01
"""A tool that presses nearer than this to where a surface is believed to be presses on it: nobody calibrates better."""


class SinkBelow(Primitive):
    """Waits up to `patience` s until the tool is `depth` m below a target, against the unit direction `along` (3,).

    A tool that presses near the target at the start touches the surface there, so that it has to sink as much from
    where it is. Then the opening of the socket `into`, if one is given, is written to be at this height.
    """

    moves = NOTHING
    activity = "search"

    def __init__(
        self,
        cell: Cell,
        *,
        arm: str,
        target: Pose,
        along: Array,
        depth: float,
        patience: float,
        into: str | None = None,
    ) -> None:
        super().__init__(cell)
        self.arm, self._target, self._along, self._into = cell.arm(arm), target.position, along, into
        self._depth, self._patience, self._began, self._deepest = depth, patience, 0.0, -np.inf

    def start(self) -> None:
        """Start waiting; take the height of the surface from where the tool touches it."""
        raise_fault(self.arm)
        self._began = self.cell.now
        higher = float(self._along @ (self.arm.measured.pose.position - self._target))
        if abs(higher) < UNSURE_M:
            self._target = self._target + higher * self._along
            self._write_height(higher)

    def tick(self) -> Status:
        """Return SUCCESS when the tool is deep enough."""
        raise_fault(self.arm)
        depth = float(self._along @ (self._target - self.arm.measured.pose.position))
        self._deepest = max(self._deepest, depth)
        if depth >= self._depth:
            return Status.SUCCESS
        if self.cell.now - self._began > self._patience:
            raise SkillFailure(
                "nothing gave way within {patience}: the tool sank {sank:.1f mm} below the target, not {wanted:g mm}"
                + describe_slowness(self.arm.speed),
                patience=LabelledQuantity(self._patience, "s"),
                sank=LabelledQuantity(self._deepest, "m"),
                wanted=LabelledQuantity(self._depth, "m"),
            )
        return Status.RUNNING

    def _write_height(self, higher: float) -> None:
        """Write that the opening of the socket is higher by so many m, along the axis, than it was believed to be."""
        if self._into is None:
            return
        state = self.cell.world.snapshot()
        believed = pose(state, self._into)
        found = Pose(believed.position + higher * self._along, believed.rotation)
        self.cell.world.commit(relocation_changes(state, self._into, found), "SinkBelow", "sensed")


class Seat(Primitive):
    """Waits up to `patience` s until a pushed peg rests in a socket; writes its depth and if it is at the bottom."""

    moves = NOTHING
    highlights = (("begins", "socket", "found"), ("ends", "socket", "filled"))

    def __init__(self, cell: Cell, *, arm: str, object: str, socket: str, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._peg, self._socket, self._patience = cell.arm(arm), object, socket, patience
        self._began = self._came_at = self._bottom = 0.0
        self._opening, self._place = Pose.of((0.0, 0.0, 0.0)), np.zeros(3)

    def start(self) -> None:
        """Look up the assumed pose of the opening; SkillFailure if the depth of the hole is not known."""
        raise_fault(self.arm)
        state = self.cell.world.snapshot()
        try:
            self._bottom = number_of(state, self._socket, DEPTH)
        except SheetError as error:
            raise SkillFailure(str(error)) from error
        self._opening = pose(state, self._socket)
        self._began = self._came_at = self.cell.now
        self._place = self.arm.measured.pose.position

    def tick(self) -> Status:
        """Return SUCCESS when the peg rests at the bottom; SkillFailure if it rests elsewhere or time is up."""
        raise_fault(self.arm)
        place = self.arm.measured.pose.position
        if float(np.linalg.norm(place - self._place)) > REST_RANGE_M:
            self._place, self._came_at = place, self.cell.now
        resting = self.cell.now - self._came_at >= REST_TIME_S
        if not resting and self.cell.now - self._began <= self._patience:
            return Status.RUNNING
        depth = -float(self._opening.inverse().apply(self.arm.measured.pose.position)[2])
        seated = resting and abs(depth - self._bottom) <= (1 - SEATED_SHARE) * self._bottom
        noted = [SetProperty(self._peg, INSERTED_DEPTH, depth), SetProperty(self._peg, IS_SEATED, seated)]
        self.cell.world.commit(noted, "Seat", "sensed")
        if not seated:
            words = self.cell.world.snapshot().vocabulary
            rest = "rests" if resting else "still moves after {patience},"
            raise SkillFailure(
                f"{{object}} {rest} {{depth:.1f mm}} deep in {{socket}}, which is {{hole:.1f mm}} deep"
                + ("" if resting else describe_slowness(self.arm.speed)),
                object=label(self._peg, words),
                socket=label(self._socket, words),
                patience=LabelledQuantity(self._patience, "s"),
                depth=LabelledQuantity(depth, "m"),
                hole=LabelledQuantity(self._bottom, "m"),
            )
        return Status.SUCCESS
