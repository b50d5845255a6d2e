"""Lowers what is held until it stands on something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.primitives.compliance import Push
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.state.labelled import Quantity, label

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.motion.pose import Array

APPROACH_M_S = 0.02
"""How fast a held thing is lowered."""


class PressOnSupport(Push):
    """Lowers `object` opposite to `along` (3,), then presses it on what it stands on with `force` N in the scope.

    Fails if it touches nothing within `travel` m.
    """

    activity = ""

    def __init__(
        self, cell: Cell, *, arm: str, along: Array, object: str, to: str, force: float, travel: float
    ) -> None:
        super().__init__(cell, arm=arm, along=along, force=force, travel=travel, approach=APPROACH_M_S)
        self._object, self._to, self._travel = object, to, travel

    def tick(self) -> Status:
        """Return SUCCESS once the object presses on its support; SkillFailure if nothing supports it."""
        try:
            return super().tick()
        except SkillFailure as failure:
            words = self.cell.world.snapshot().vocabulary
            raise SkillFailure(
                "nothing supports {object} where it should stand at {to}: {reason}; it was lowered by up to "
                "{travel:.0f mm}",
                object=label(self._object, words),
                to=label(self._to, words),
                reason=str(failure),
                travel=Quantity(self._travel, "m"),
            ) from failure
