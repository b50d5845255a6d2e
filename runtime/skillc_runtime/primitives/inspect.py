"""Inspects how much of a surface is wiped."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import CLEAN_THRESHOLD, COVERAGE, IS_CLEAN


class Inspect(Primitive):
    """Measures the share of a surface that is wiped; it is clean if that reaches the surface's threshold.

    The camera determines the evidence: `idealised` of a simulated one, `sensed` of a real one.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, surface: str) -> None:
        super().__init__(cell)
        self._surface = surface

    def start(self) -> None:
        """SkillFailure if the world model has no threshold for the surface."""
        short = self.cell.world.snapshot().vocabulary.short
        if not isinstance(self._threshold(), float):
            raise SkillFailure(f"the world model has no wiping:cleanThreshold for {short(self._surface)}")

    def tick(self) -> Status:
        """Measure, write coverage and cleanness, and return SUCCESS."""
        camera, threshold = self.cell.camera(), self._threshold()
        seen = camera.inspect(self._surface)
        clean = isinstance(threshold, float) and seen >= threshold
        self.cell.world.commit(
            [SetProperty(self._surface, COVERAGE, seen), SetProperty(self._surface, IS_CLEAN, clean)],
            "Inspect",
            camera.evidence,
        )
        return Status.SUCCESS

    def _threshold(self) -> object:
        return self.cell.world.snapshot().value(self._surface, CLEAN_THRESHOLD)
