"""Inspects how much of a surface is wiped."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.devices.cell import Cell
from skillc_runtime.motion.layout import Patch
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.space.frames import frame_name, placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, RemoveIndividual, SetProperty
from skillc_runtime.world.state.terms import AREA, CLEAN_THRESHOLD, COVERAGE, HAS_PATCH, IS_CLEAN, SIZE


class Inspect(Primitive):
    """Measures the share of a surface that is wiped; it is clean if that reaches the surface's threshold.

    The camera determines the evidence: `sensed` of a real one, or of one whose images are rendered, `idealised` of one
    that reads the map of the simulator. What an image shows dirty becomes patches of the surface, to be wiped again.
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
        parts = () if clean else camera.dirty_parts(self._surface)
        measured = [SetProperty(self._surface, COVERAGE, seen), SetProperty(self._surface, IS_CLEAN, clean)]
        self.cell.world.commit([*measured, *self._patches(parts)], "Inspect", camera.evidence)
        return Status.SUCCESS

    def _threshold(self) -> object:
        return self.cell.world.snapshot().value(self._surface, CLEAN_THRESHOLD)

    def _patches(self, parts: tuple[Patch, ...]) -> Iterator[Change]:
        """Yield the changes by which the patches of an earlier inspection go, and parts become patches.

        A surface of which only some patches are to be wiped keeps these.
        """
        state, prefix = self.cell.world.snapshot(), f"{self._surface}-dirty-"
        patches = state.objects(self._surface, HAS_PATCH)
        if any(not each.startswith(prefix) for each in patches):
            return
        yield from (RemoveIndividual(each) for each in sorted(patches))
        for number, part in enumerate(parts):
            patch = f"{prefix}{number}"
            yield AddIndividual(patch, (AREA,))
            yield AddRelation(self._surface, HAS_PATCH, patch)
            yield from placement_changes(patch, part.pose, frame_name(state, self._surface))
            yield from (SetProperty(patch, name, float(each)) for name, each in zip(SIZE, part.size, strict=False))
