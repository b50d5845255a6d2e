"""Waits for a button to switch."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.primitives.arm_motion import raise_fault
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.primitives.time_limits import describe_slowness
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.labels.labelled import LabelledQuantity
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import IS_ON, PRESSED_WITH

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

PRESS_HOLD_S = 0.2
"""How long a button is held after it has switched; the force is the mean over this time."""


class AwaitSwitch(Primitive):
    """Waits up to `patience` s until the button that the arm presses has switched; writes that and the force in N."""

    moves = NOTHING
    stays_put = True
    highlights = (("ends", "button", "pressed"),)

    def __init__(self, cell: Cell, *, arm: str, button: str, patience: float) -> None:
        super().__init__(cell)
        self.arm, self._switch = cell.arm(arm), cell.button(button)
        self._button, self._patience, self._began = button, patience, 0.0
        self._switched_at: float | None = None
        self._forces: list[float] = []

    def start(self) -> None:
        """Start waiting."""
        raise_fault(self.arm)
        self._began = self.cell.now

    def tick(self) -> Status:
        """Return SUCCESS when the button has switched and was held."""
        raise_fault(self.arm)
        if self._switched_at is None and self._switch.switched:
            self._switched_at, self._forces = self.cell.now, []
        self._forces.append(self.arm.measured.pressing_n)
        if self._switched_at is not None and self.cell.now - self._switched_at >= PRESS_HOLD_S:
            self._note()
            return Status.SUCCESS
        if self._switched_at is None and self.cell.now - self._began > self._patience:
            raise SkillFailure(
                "{button} has not switched within {patience}, pressed with {force:.1f}"
                + describe_slowness(self.arm.speed),
                button=label(self._button, self.cell.world.snapshot().vocabulary),
                patience=LabelledQuantity(self._patience, "s"),
                force=LabelledQuantity(self._force, "N"),
            )
        return Status.RUNNING

    @property
    def _force(self) -> float:
        return sum(self._forces) / len(self._forces)

    def _note(self) -> None:
        world = self.cell.world
        world.commit([SetProperty(self._button, IS_ON, True)], "AwaitSwitch", "reported")
        force = SetProperty(self._button, PRESSED_WITH, self._force)
        world.commit([force], "AwaitSwitch", "assumed" if self.arm.measured.felt is None else "sensed")
