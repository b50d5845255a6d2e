"""Looking at a polished surface and noting what was seen."""

from __future__ import annotations

from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, number
from skillc_runtime.world.state.terms import IS_POLISHED, POLISH_THRESHOLD, POLISH_TIME, POLISHED_SHARE


class InspectPolish(Primitive):
    """Measures which share of a surface was rubbed long enough; it is polished when that share is large enough."""

    def __init__(self, cell: Cell, *, surface: str) -> None:
        super().__init__(cell)
        self._surface, self._time, self._threshold = surface, 0.0, 1.0

    def start(self) -> None:
        """SkillFailure when the world model does not say when the surface counts as polished."""
        state = self.cell.world.snapshot()
        try:
            self._time, self._threshold = (number(state, self._surface, p) for p in (POLISH_TIME, POLISH_THRESHOLD))
        except SheetError as error:
            raise SkillFailure(str(error)) from error

    def tick(self) -> Status:
        """Look, and note what was seen."""
        seen = self.cell.camera().rubbed(self._surface, self._time)
        polished = SetProperty(self._surface, IS_POLISHED, seen >= self._threshold)
        self.cell.world.commit([SetProperty(self._surface, POLISHED_SHARE, seen), polished], "Inspect", "sensed")
        return Status.SUCCESS
