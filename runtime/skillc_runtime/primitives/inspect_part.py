"""Inspects a part: what it is, and whether it is good."""

from __future__ import annotations

from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.primitives.awaited_image import AwaitedImage
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.terms import CODE, CONFIDENCE, OF_KIND


class InspectPart(Primitive):
    """Looks at a part with the inspection camera; its outcome is `good` or `scrap`.

    Code, kind and confidence are written as sensed. SkillFailure with the reason if the image does not decide, or no
    image is taken: nothing is written then.
    """

    moves = NOTHING
    stays_put = True

    def __init__(self, cell: Cell, *, part: str, at: str) -> None:
        super().__init__(cell)
        self._part = part

    def start(self) -> None:
        """Ask for an image."""
        self._image = AwaitedImage(self.cell)

    def tick(self) -> Status:
        """Take an image, write what it shows, and return SUCCESS."""
        if not self._image.is_there:
            return Status.RUNNING
        try:
            seen = self.cell.camera().classify(self._part)
        except NoSuchDevice as error:
            raise SkillFailure("{reason}", reason=str(error)) from error
        kinds = self.cell.world.snapshot().objects(self._part, OF_KIND)
        changes: list[Change] = [RemoveRelation(self._part, OF_KIND, each) for each in sorted(kinds - {seen.kind})]
        changes.append(AddRelation(self._part, OF_KIND, seen.kind))
        changes.append(SetProperty(self._part, CODE, seen.code))
        changes.append(SetProperty(self._part, CONFIDENCE, seen.confidence))
        self.cell.world.commit(changes, "InspectPart", "sensed")
        self.outcome = "good" if seen.good else "scrap"
        return Status.SUCCESS
