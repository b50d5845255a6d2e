"""Driving a mobile base to where a workstation wants it to stand."""

from __future__ import annotations

from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.robots.contradictions import away
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.terms import AT


class DriveBase(Primitive):
    """Drives to a workstation and notes that the base reports to be there; the arms on it hold their posture."""

    def __init__(self, cell: Cell, *, robot: str, to: str) -> None:
        super().__init__(cell)
        self._base, self._robot, self._to = cell.base(robot), robot, to

    def start(self) -> None:
        """Begin to drive."""
        self._base.drive_to(pose(self.cell.world.snapshot(), self._to))

    def tick(self) -> Status:
        """Wait until the base is there; SkillFailure where it reports another place."""
        if not self._base.done:
            return Status.RUNNING
        elsewhere = away(self.cell, self._robot, self._to, self.cell.world.snapshot())()
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
        """Drive on from wherever the base stands."""
        self.start()
