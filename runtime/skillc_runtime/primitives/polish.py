"""Inspects how much of a surface is polished."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import POLISH_THRESHOLD, POLISH_TIME, POLISHED_SHARE


class InspectPolish(Primitive):
    """Measures the share of a surface that was rubbed long enough; the world model judges whether that is enough.

    The camera determines the evidence: `idealised` of a simulated one, `sensed` of a real one.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, surface: str) -> None:
        super().__init__(cell)
        self._surface, self._time = surface, 0.0

    def start(self) -> None:
        """SkillFailure if the world model has no polishing time or threshold for the surface."""
        state = self.cell.world.snapshot()
        try:
            self._time, _ = (number_of(state, self._surface, each) for each in (POLISH_TIME, POLISH_THRESHOLD))
        except SheetError as error:
            raise SkillFailure(str(error)) from error

    def tick(self) -> Status:
        """Measure, write the share, from which it is judged whether it is polished, and return SUCCESS."""
        camera = self.cell.camera()
        seen = camera.rubbed_share(self._surface, self._time)
        self.cell.world.commit([SetProperty(self._surface, POLISHED_SHARE, seen)], "Inspect", camera.evidence)
        return Status.SUCCESS
