"""Drives a mobile base to a workstation."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.fact_monitor import base_away_from
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.terms import AT


class DriveBase(Primitive):
    """Drives to a workstation and writes the place that the base reports; the arms on it hold their posture."""

    def __init__(self, cell: Cell, *, robot: str, to: str) -> None:
        super().__init__(cell)
        self._base, self._robot, self._to = cell.base(robot), robot, to

    def start(self) -> None:
        """Start driving."""
        self._base.drive_to(pose(self.cell.world.snapshot(), self._to))

    def tick(self) -> Status:
        """Return SUCCESS when the base has arrived; SkillFailure if it reports another place."""
        if not self._base.done:
            return Status.RUNNING
        elsewhere = base_away_from(self.cell, self._robot, self._to, self.cell.world.snapshot())()
        if elsewhere is not None:
            raise SkillFailure(elsewhere)
        self.cell.world.commit([AddRelation(self._robot, AT, self._to)], "DriveBase", "reported")
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        """Brake."""
        self._base.stop()

    def pause(self) -> None:
        """Brake."""
        self._base.stop()

    def resume(self) -> None:
        """Drive on from the current pose."""
        self.start()
