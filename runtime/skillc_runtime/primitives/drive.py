"""Driving a mobile base to where a workstation wants it to stand."""

from __future__ import annotations

from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.world.frames import pose


class DriveBase(Primitive):
    """Drives to a workstation; the arms on the base hold their posture meanwhile."""

    def __init__(self, cell: Cell, *, robot: str, to: str) -> None:
        super().__init__(cell)
        self._base, self._to = cell.base(robot), to

    def start(self) -> None:
        """Begin to drive."""
        self._base.drive_to(pose(self.cell.world.snapshot(), self._to))

    def tick(self) -> Status:
        """Wait until the base is there."""
        return Status.SUCCESS if self._base.done else Status.RUNNING

    def halt(self, reason: str) -> None:
        """Brake."""
        self._base.stop()

    def pause(self) -> None:
        """Brake."""
        self._base.stop()

    def resume(self) -> None:
        """Drive on from wherever the base stands."""
        self.start()
