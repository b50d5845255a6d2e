"""Tells users something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import NOTHING, Primitive, Status

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class Note(Primitive):
    """Writes a text into the recording of the run, where whoever watches sees it."""

    moves = NOTHING
    stays_put = True
    uses_devices = False

    def __init__(self, cell: Cell, *, text: str) -> None:
        super().__init__(cell)
        self.note = text

    def tick(self) -> Status:
        """Succeed."""
        return Status.SUCCESS
