"""Inspects how much of a surface is wiped."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.motion.dirt_map import DirtMap, format_dirt_map
from skillc_runtime.primitives.awaited_image import AwaitedImage
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import Change, ClearProperty, SetProperty
from skillc_runtime.world.state.terms import CLEAN_THRESHOLD, COVERAGE, DIRT_MAP


class Inspect(Primitive):
    """Measures where a surface is clean; the world model judges by the surface's threshold whether that is enough.

    The camera determines the evidence: `sensed` of a real one, or of one whose images are rendered, `idealised` of one
    that reads the map of the simulator. What the map shows dirty is what is to be wiped.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, surface: str) -> None:
        super().__init__(cell)
        self._surface = surface

    def start(self) -> None:
        """SkillFailure if the world model has no threshold for the surface."""
        state = self.cell.world.snapshot()
        if not isinstance(state.value(self._surface, CLEAN_THRESHOLD), float):
            short = state.vocabulary.short(self._surface)
            raise SkillFailure(f"the world model has no wiping:cleanThreshold for {short}")
        self._image = AwaitedImage(self.cell)

    def tick(self) -> Status:
        """Measure, write the share and the map, from which it is judged whether it is clean, and return SUCCESS."""
        if not self._image.is_there:
            return Status.RUNNING
        camera = self.cell.camera()
        share = SetProperty(self._surface, COVERAGE, camera.inspect(self._surface))
        self.cell.world.commit([share, self._write(camera.dirt_map(self._surface))], "Inspect", camera.evidence)
        return Status.SUCCESS

    def _write(self, dirt: DirtMap | None) -> Change:
        """Return the change by which a map replaces that of an earlier inspection."""
        if dirt is None:
            return ClearProperty(self._surface, DIRT_MAP)
        return SetProperty(self._surface, DIRT_MAP, format_dirt_map(dirt))
