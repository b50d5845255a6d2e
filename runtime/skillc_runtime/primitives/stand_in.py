"""A placeholder for code that is not written yet, so that skills can be checked, planned and tried."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.primitives.primitive import Primitive, Status

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class StandIn(Primitive):
    """Succeeds at once without moving anything, with any parameters; the skill's posts are applied as usual.

    What comes of a skill with outcomes is what a simulated scene says to be true.
    """

    outcome_evidence = "idealised"

    def __init__(self, cell: Cell, **parameters: object) -> None:
        super().__init__(cell)

    def tick(self) -> Status:
        """Return SUCCESS."""
        self.outcome = self.true_outcome
        return Status.SUCCESS
