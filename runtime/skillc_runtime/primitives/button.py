"""Noticing that a button has switched."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import IS_ON, PRESSED_WITH

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell

HOLD_S = 0.2
"""How long a button stays pressed once it has switched; the force is the mean over this time."""


class AwaitSwitch(Primitive):
    """Wait up to `patience` s until a button, which the arm presses, has switched; note that, and the force in N."""

    def __init__(self, cell: Cell, *, arm: str, button: str, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._switch = cell.arm(arm), cell.button(button)
        self._button, self._patience, self._began = button, patience, 0.0
        self._switched_at: float | None = None
        self._forces: list[float] = []

    def start(self) -> None:
        """Begin to wait."""
        raise_fault(self.arm)
        self._began = self.cell.now

    def tick(self) -> Status:
        """Return SUCCESS once the button has switched and was held."""
        raise_fault(self.arm)
        if self._switched_at is None and self._switch.switched:
            self._switched_at, self._forces = self.cell.now, []
        self._forces.append(-float(self.arm.wrench[:3] @ self.arm.pose.rotation[:, 2]))
        if self._switched_at is not None and self.cell.now - self._switched_at >= HOLD_S:
            self._note()
            return Status.SUCCESS
        if self._switched_at is None and self.cell.now - self._began > self._patience:
            name = self.cell.world.snapshot().vocabulary.short(self._button)
            raise SkillFailure(f"{name} has not switched within {self._patience:g} s, pressed with {self._force:.1f} N")
        return Status.RUNNING

    @property
    def _force(self) -> float:
        return sum(self._forces) / len(self._forces)

    def _note(self) -> None:
        world = self.cell.world
        world.commit([SetProperty(self._button, IS_ON, True)], "AwaitSwitch", "reported")
        world.commit([SetProperty(self._button, PRESSED_WITH, self._force)], "AwaitSwitch", "sensed")
